"""Moving an installation: all rows and files from one database and store to another, without loss."""
