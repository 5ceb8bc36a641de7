# Everything a newcomer needs: `make run`, `make test`, `make check`, `make docs`, `make wheel`.
# All of it happens in .venv; nothing is installed into the system's Python.
PYTHON ?= python3
VENV   ?= .venv
PIP    := $(VENV)/bin/python -m pip --disable-pip-version-check
OUT    ?= runs/texture-steel

.PHONY: run test slow check docs wheel release clean help

help:
	@echo "make run    compute the texture of a pulse on steel into $(OUT) and write its figures and report"
	@echo "make test   run the tests          make check  format, lint, types, tests"
	@echo "make slow   run the long tests that make test leaves out"
	@echo "make docs   build docs/_build/html make wheel  build dist/lasersph-*.whl"
	@echo "make release  checks, wheel and source archive tried in an empty environment, notes: dist/"

# --resume continues an interrupted run, and only says so when the run is finished already.
run: $(VENV)/.run
	$(VENV)/bin/lasersph run texture-steel --out $(OUT) --resume
	@echo "Open $(OUT)/report.html in a browser. Start anew: rm -r $(OUT)"

test: $(VENV)/.test
	@echo "Tests take 15 minutes with 2 cores, as these are."
	@command -v chromium chromium-browser google-chrome google-chrome-stable >/dev/null || echo \
	  "No Chromium: the tests of the page are skipped. On Debian: apt-get install chromium" >&2
	$(VENV)/bin/python -m pytest $(WORKERS) $(PYTEST_ARGS)

slow: $(VENV)/.test
	$(VENV)/bin/python -m pytest $(WORKERS) -m slow $(PYTEST_ARGS)

check: $(VENV)/.check
	$(VENV)/bin/ruff format --check .
	$(VENV)/bin/ruff check .
	$(VENV)/bin/pyright --pythonpath $(VENV)/bin/python
	$(VENV)/bin/python -m pytest $(WORKERS) $(PYTEST_ARGS)

docs: $(VENV)/.docs
	$(VENV)/bin/python docs/draw_architecture.py
	@$(VENV)/bin/python docs/draw_figures.py --check || echo "Draw them: $(VENV)/bin/python docs/draw_figures.py"
	$(VENV)/bin/python -m sphinx -j auto -W --keep-going -q -b html docs docs/_build/html
	@echo "Open docs/_build/html/index.html in a browser."

wheel: $(VENV)/.test
	$(VENV)/bin/python -m build --wheel

# All that a version needs before it is tagged: see "Release" in CONTRIBUTING.md.
release: check slow
	@test -z "$$(git status --porcelain)" || { echo "commit first: the tree has changes" >&2; exit 1; }
	@mkdir -p dist && $(VENV)/bin/python docs/release_notes.py > dist/notes.md
	$(VENV)/bin/python -m pytest -m release
	$(VENV)/bin/python -m build --outdir dist
	@echo "dist/ holds wheel, source archive and notes.md; next: git tag v$$($(VENV)/bin/lasersph --version | tr -dc '0-9.')"

clean:
	rm -rf $(VENV) dist docs/_build docs/generated

# Filled by the pip beside PYTHON, in half the time that ensurepip takes to unpack and translate its
# own; that does where there is no such pip, or no uv. Debian's Python may lack both.
$(VENV)/bin/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	  echo "lasersph needs Python 3.11 or newer; '$(PYTHON)' is not. Try: make PYTHON=python3.11 ..." >&2; exit 1; }
	@$(call new_venv,pip uv) || $(PYTHON) -m venv --clear $(VENV) >/dev/null 2>&1 || $(call new_venv,pip) \
	  || { rm -rf $(VENV); echo "No virtual environment could be made: $(PYTHON) has neither venv nor" \
	       "pip. On Debian: apt install python3-venv python3-pip" >&2; exit 1; }

new_venv = { $(PYTHON) -m venv --clear --without-pip $(VENV) && $(PYTHON) -m pip \
	  --disable-pip-version-check --python $(VENV)/bin/python install --quiet --no-compile $(1); } 2>/dev/null

# A stamp per set of extras, renewed when the metadata changes.
# Without bytecode, of which a run needs a part: half the time.
$(VENV)/.run: pyproject.toml | $(VENV)/bin/python
	@$(call install,.)
	@touch $@

$(VENV)/.%: pyproject.toml | $(VENV)/bin/python
	@$(call install,'.[$(subst check,check$(comma)test,$*)$(if $(filter test check,$*),$(GPU))]')
	@touch $@

# uv installs in a third of pip's time; pip does where uv cannot be had, or finds less than pip.
install = $(VENV)/bin/uv pip install --quiet --python $(VENV)/bin/python --editable $(1) 2>/dev/null \
	  || $(PIP) install --quiet --no-compile --editable $(1)

# Tests run in as many processes as there are cores; in four at most, since each imports everything.
WORKERS := -n logical --maxprocesses 4 --dist worksteal
# Tests start hundreds of programs, which find what the first of them has translated to bytecode.
unexport PYTHONDONTWRITEBYTECODE
comma := ,
# Tests of the CUDA backend need no graphics card, but its compiler, which there is for Linux.
GPU := $(if $(filter Linux,$(shell uname -s)),$(comma)gpu)
