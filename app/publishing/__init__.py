"""Reports and data packages: what leaves the laboratory, of runs and diagnoses."""
