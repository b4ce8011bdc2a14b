"""What the add-on promises, tested in Blender. Run by test_addon.py; arguments behind -- are those of unittest."""
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import support  # noqa: E402, F401  (switches the add-on on)
from bake_cases import *  # noqa: E402, F403
from simulation_cases import *  # noqa: E402, F403

arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
result = unittest.main(module=__name__, argv=["addon_cases.py", *arguments], exit=False).result
if not result.wasSuccessful() or result.testsRun == 0:
    sys.exit(1)
