"""Files as laboratories and networks write them: each is read into one table, and its header is compared with its data."""
