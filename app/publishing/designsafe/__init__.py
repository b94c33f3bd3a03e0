"""A run as a data set for DesignSafe's Data Depot: the entities of a hybrid simulation with their files and metadata."""
