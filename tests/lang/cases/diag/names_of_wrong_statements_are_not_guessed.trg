a = ;            //! E205@5
print(a + 1);
