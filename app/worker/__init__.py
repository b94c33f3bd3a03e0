"""The worker: executes queued jobs in processes of its own."""
