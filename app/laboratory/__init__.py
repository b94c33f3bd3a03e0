"""The laboratory's identity: name, address, logo and signatures in the header and at the end of every report."""
