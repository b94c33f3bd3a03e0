"""Abort: a latch in memory, a command to every worker, and a record in the database that follows. Nothing can starve it."""
