"""The service: REST, pages, live stream, workers and command line over the engine."""
