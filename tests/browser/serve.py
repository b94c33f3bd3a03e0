"""The whole service for a browser test: `python -m tests.browser.serve DATA PORT`, on RTHS_DATABASE_URL where it is set.

With a third argument the processes of calculations start with it, as in `rths serve`, instead of with the first calculation.
"""

from __future__ import annotations

import sys
from pathlib import Path

import uvicorn

from app.imports import uncollected

with uncollected():
    from app.cli.serve import LIVE
    from app.config import from_environment
    from app.main import create_app

if __name__ == "__main__":
    data, port = Path(sys.argv[1]), int(sys.argv[2])
    settings = from_environment(data=data, port=port, local_sign_in=True)
    app = create_app(settings)
    if len(sys.argv) > 3:
        app.state.calculations.processes.start()
    uvicorn.run(app, host="127.0.0.1", port=port, log_level="warning", **LIVE)
