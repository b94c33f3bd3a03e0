"""The parts of a test: structures, integrators, actuators, compensators, specimens, left-out physics and ground motions."""
