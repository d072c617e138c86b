"""The programs of docs/python.md and the examples run; the stubs name what the module has."""

import ast
import os
import re
import subprocess
import sys

import pytest

import scree


def run(arguments, folder):
    return subprocess.run([sys.executable, *arguments], cwd=folder, capture_output=True, text=True, check=False,
                          env=dict(os.environ), timeout=250)


def programs(source):
    return re.findall(r"^```python\n(.*?)^```$", (source / "docs/python.md").read_text(), re.MULTILINE | re.DOTALL)


def test_every_program_of_the_page_runs(source, tmp_path, port):
    texts = programs(source)
    assert len(texts) >= 3
    (tmp_path / "session.scree").write_bytes((source / "tests/data/format_4/hills.scree").read_bytes())
    for text in texts:
        (tmp_path / "program.py").write_text(text.replace("port=4177", f"port={port}"))
        said = run(["program.py"], tmp_path)
        assert said.returncode == 0, text + said.stderr
        for line in re.findall(r"# prints: (.*)", text):
            assert line in said.stdout, said.stdout


@pytest.mark.parametrize("name, arguments, expected", [
    ("degradation.py", ["--carves", "20", "--out", "figure"], "carves"),
    ("excavator.py", ["--worlds", "4", "--rounds", "2", "--actions", "3"], "m³"),
    ("fragments.py", ["--blows", "2"], "shape"),
])
def test_the_examples_run(source, tmp_path, name, arguments, expected):
    said = run([source / "examples/python" / name, *arguments], tmp_path)
    assert said.returncode == 0, said.stderr
    assert expected in said.stdout
    if name == "degradation.py":
        assert len((tmp_path / "figure.csv").read_text().splitlines()) == 21


def stub_names(nodes):
    """Functions, classes and typed values; aliases of types are the stubs' own."""
    for node in nodes:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name
        elif isinstance(node, ast.AnnAssign):
            yield node.target.id


def test_the_stubs_name_what_the_module_has(source):
    tree = ast.parse((source / "python/scree.pyi").read_text())
    assert set(stub_names(tree.body)) - {"__version__"} == {n for n in dir(scree) if not n.startswith("_")}
    for node in tree.body:
        if isinstance(node, ast.ClassDef) and node.name != "Error":
            own = {name for name in stub_names(node.body) if not name.startswith("_")}
            found = {name for name in vars(getattr(scree, node.name)) if not name.startswith("_")}
            if node.name == "Batch" and not found:  # a class of Gymnasium's over the module's own
                continue
            assert own == found, node.name
    for name in dir(scree):
        if not name.startswith("_") and callable(getattr(scree, name)):
            assert getattr(scree, name).__doc__, name
