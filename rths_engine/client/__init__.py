"""The server of a rig for a client, such as OpenSees, that computes the structure and sends displacements."""
