print("/* no */ // no");
//= /* no */ // no
