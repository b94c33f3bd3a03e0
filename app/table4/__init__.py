"""The twelve simulations of Table IV, queued together and compared with the paper."""
