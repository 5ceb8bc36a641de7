"""`python -m lasersph` is `lasersph`."""

import sys

from lasersph.cli import main

sys.exit(main())
