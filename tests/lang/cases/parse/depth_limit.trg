//@ let ONES = "+1" * 300
x = ((0${ONES})${ONES})${ONES};   //! E220@1586: 200
