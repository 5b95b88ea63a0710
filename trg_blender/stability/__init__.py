"""Stiff and extreme cases: rows that measure one of them each, and how `trg stability` runs them all."""
