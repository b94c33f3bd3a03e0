"""A league of compensators on the virtual RTHS benchmark of Silva et al. (2020)."""
