"""The queue of tests: its order, hold and abort, why each test waits, and when it is expected to start and end."""
