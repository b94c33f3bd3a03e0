"""`python -m app.worker`."""

from app.imports import uncollected

with uncollected():
    from app.worker.main import main

if __name__ == "__main__":
    main()
