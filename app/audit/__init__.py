"""The audit log: who did what and when, as a chain of hashes that only grows."""
