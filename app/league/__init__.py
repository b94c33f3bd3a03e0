"""The league of compensators on the virtual RTHS benchmark: measured results, shipped or from the data folder."""
