#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What `make` runs before anything else, from the root of the project:
#
#   tools/setup.sh venv FOLDER        a virtual environment with the pinned packages, on Python 3.11 or 3.13
#   tools/setup.sh libraries FOLDER   the system libraries that Blender and OpenGL need beside it
#
# The second one installs what is missing if it runs as root where there is apt-get, and else says in one line what to install.
# PYTHON=/path/to/python chooses the interpreter.
set -euo pipefail

fail() {
  echo "setup: $*" >&2
  exit 1
}

version_of() {
  "$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null
}

# find_python VENV: the first interpreter that a Blender module exists for, the environment's own before others. Tried by
# running it: a version manager's shim may lead nowhere.
find_python() {
  local candidate
  for candidate in ${PYTHON:-"$1/bin/python" python3.11 python3.13 python3}; do
    case $(version_of "$candidate") in 3.11 | 3.13) echo "$candidate" && return ;; esac
  done
  fail "Python 3.11 or 3.13 is needed (Blender's module exists for no other), but ${PYTHON:-python3} is" \
    "$(version_of "${PYTHON:-python3}" || echo missing); set PYTHON=/path/to/one"
}

# install_system PACKAGE...: Debian's names of packages
install_system() {
  if [[ $EUID != 0 ]] || ! command -v apt-get >/dev/null; then
    fail "system packages are missing (here by their Debian names); as root: apt-get install $*"
  fi
  echo "setup: apt-get install $*"
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends "$@" >/dev/null
}

make_venv() {
  local venv=$1 python
  python=$(find_python "$venv")
  if [[ $(version_of "$venv/bin/python") != "$(version_of "$python")" ]]; then
    "$python" -c 'import ensurepip' 2>/dev/null || install_system "python$(version_of "$python")-venv"
    echo "setup: $venv with Python $(version_of "$python")"
    "$python" -m venv --clear "$venv"
  fi
  echo "setup: installing Blender's module and the other packages (about 400 MB the first time)"
  "$venv/bin/python" -m pip install --quiet --disable-pip-version-check -r requirements/dev.txt
}

# Libraries that bpy links and the loader does not find, as Debian names their packages: libXi.so.6 is in libxi6, and a
# name that ends in a digit gets a hyphen, libX11.so.6 is in libx11-6.
packages_for_bpy() {
  ldd "$1"/lib/python3.*/site-packages/bpy/__init__.so | awk '/=> not found/ {print tolower($1)}' | sort -u |
    sed -E 's/([0-9])\.so\.([0-9]+).*/\1-\2/; s/\.so\.([0-9]+).*/\1/'
}

has_opengl() {
  "$1/bin/python" -c 'import moderngl
moderngl.create_context(standalone=True, backend="egl", require=430, libgl="libGL.so.1", libegl="libEGL.so.1")' &>/dev/null
}

# Mesa's OpenGL, which has a software device, unless a context of OpenGL 4.3 can be had already
packages_for_opengl() {
  local package
  if has_opengl "$1"; then return; fi
  for package in libegl1 libgl1 libgl1-mesa-dri; do
    dpkg -s "$package" &>/dev/null || echo "$package"
  done
}

# The compiler that `make lint` reads shaders with. Without it lint says so and goes on, so nothing fails for the lack of it.
packages_for_lint() {
  if [[ $EUID == 0 ]] && command -v apt-get >/dev/null && ! command -v glslangValidator >/dev/null; then echo glslang-tools; fi
}

install_libraries() {
  local packages
  packages=$( (packages_for_bpy "$1" && packages_for_opengl "$1" && packages_for_lint) | sort -u | xargs)
  # shellcheck disable=SC2086 # names of packages hold no spaces
  if [[ -n $packages ]]; then install_system $packages; fi
  has_opengl "$1" || echo "setup: no OpenGL 4.3 through EGL yet: renders will say what is missing" >&2
}

case ${1:-} in
  venv) make_venv "$2" ;;
  libraries) install_libraries "$2" ;;
  *) fail "usage: tools/setup.sh venv|libraries FOLDER" ;;
esac
