"""The job machine: states, queues, attempts and cancelling, the same for every kind of job."""
