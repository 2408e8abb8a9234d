# Sourced by run.sh and test.sh: makes sure that Debian packages are installed.

# What compiles the program, the driver that draws where there is no GPU, what asks the desktop for files, and what
# offers it pictures.
build_packages=(g++ cmake ninja-build pkg-config
  libgl-dev libopengl-dev libegl-dev libepoxy-dev libglfw3-dev libx11-dev libglm-dev libimgui-dev
  libtinygltf-dev libassimp-dev libstb-dev libembree-dev nlohmann-json3-dev libcli11-dev libfmt-dev
  libseccomp-dev libdraco-dev libmeshoptimizer-dev libwebp-dev libopenexr-dev libzip-dev zlib1g-dev libsdbus-c++-dev libsystemd-dev
  fonts-inter libgl1 libegl1 libegl-mesa0 libgl1-mesa-dri xclip)
# What the tests need besides: test and benchmark libraries, a display without a screen, a hand for its mouse, a second
# driver (zink over lavapipe), the reference compiler of GLSL, the formatter, what opens and makes captures.
test_packages=(libgtest-dev googletest libbenchmark-dev xvfb xauth xdotool dbus
  mesa-vulkan-drivers glslang-tools chromium parallel shellcheck clang-format graphviz
  python3-renderdoc python3-numpy librenderdoc librenderdoc-dev)
# What single stages of test.sh need, which are skipped without: a second compiler, what checks a Debian package and
# makes a clean root to install it, shells that read its completions, and npm for engines in JavaScript, which may be
# there without Debian's package. The last line holds the engines of tests/proof.
stage_packages=(clang lintian debootstrap appstream desktop-file-utils shared-mime-info zsh fish man-db
  libogre-1.12-dev libfilament-dev godot3-runner)
if ! command -v npm >/dev/null; then stage_packages+=(nodejs npm); fi

say() { printf '%s\n' "$*" >&2; }

# require_packages PACKAGE...: installs what is missing and says what; silent when all is there.
require_packages() {
  if [ -n "${SI_SKIP_PACKAGES:-}" ]; then return; fi
  if ! command -v dpkg-query >/dev/null; then
    say "This script installs packages with Debian's tools, which are not here."
    say "Install the counterparts of: $*"
    say "then run it again with SI_SKIP_PACKAGES=1."
    exit 1
  fi
  local missing=() package
  for package in "$@"; do
    if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
      missing+=("$package")
    fi
  done
  if [ ${#missing[@]} -eq 0 ]; then return; fi

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      say "Missing packages: ${missing[*]}"
      say "Neither root nor sudo is at hand to install them. Ask for: apt-get install ${missing[*]}"
      exit 1
    fi
    as_root=(sudo)
  fi
  say "Installing missing packages: ${missing[*]}"
  if ! { "${as_root[@]}" apt-get update -q &&
         "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
           apt-get install -y -q --no-install-recommends "${missing[@]}"; } >&2; then
    say "The packages could not be installed; what apt-get said stands above."
    exit 1
  fi
}

# Compilations are reused where ccache is installed.
if command -v ccache >/dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
  export CCACHE_SLOPPINESS=${CCACHE_SLOPPINESS:-pch_defines,time_macros}  # for precompiled headers
fi
