"""The control room for real-time hybrid simulation, from Python: `rths.client`."""
