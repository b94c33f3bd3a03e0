"""What happened in the laboratory, as a table that only grows: starts and ends of jobs, and holds of the queue."""
