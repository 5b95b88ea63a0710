x = mth::sin.f;   //! E421@5
