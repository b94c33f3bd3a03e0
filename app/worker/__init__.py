"""The worker: executes queued jobs in its own processes."""
