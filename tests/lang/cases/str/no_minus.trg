x = "ab" - "b";   //! E410@5: str - str
