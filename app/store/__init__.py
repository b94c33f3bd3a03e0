"""Where recordings, measured files and ground motions lie: a folder or an object store, read back verified."""
