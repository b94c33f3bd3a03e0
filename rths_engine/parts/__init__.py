"""What a test is made of: structures, integrators, actuators, compensators, specimens, left-out physics and ground motions."""
