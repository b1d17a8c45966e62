"""The notebooks of assets/notebooks run."""

import json
import os
import tempfile
import unittest
import warnings

from support import ROOT


class Notebooks(unittest.TestCase):
    def test_code_cells_run_in_order(self):
        paths = sorted((ROOT / "assets" / "notebooks").glob("*.ipynb"))
        self.assertEqual(len(paths), 3)
        before = os.getcwd()
        for path in paths:
            with self.subTest(path.name), tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
                warnings.simplefilter("ignore")
                notebook = json.loads(path.read_text(encoding="utf-8"))
                os.chdir(folder)
                try:
                    space = {}
                    for cell in notebook["cells"]:
                        if cell["cell_type"] == "code":
                            self.assertEqual(cell["outputs"], [])
                            exec(compile("".join(cell["source"]), path.name, "exec"), space)
                finally:
                    os.chdir(before)


if __name__ == "__main__":
    unittest.main()
