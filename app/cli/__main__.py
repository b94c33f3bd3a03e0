"""`python -m app.cli` is `rths`."""

import sys

from app.cli.main import main

sys.exit(main())
