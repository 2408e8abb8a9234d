#!/usr/bin/env bash
# Makes the Debian package of build/release, checks its parts, installs it in a clean root, runs it there and removes
# it. Arguments:
#   --lacks      print the needs of this test that the machine does not meet, and make nothing; exit code 0 if there are
#   PICTURE.png  keep the picture that is drawn in the clean root
# It needs root, and the mirror that apt of this machine uses.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release
export LC_ALL=C.UTF-8

lacking() {
  local command
  for command in cpack dpkg-shlibdeps lintian debootstrap appstreamcli desktop-file-validate man zsh fish; do
    if ! command -v "$command" >/dev/null && [ ! -x "/usr/sbin/$command" ]; then echo "command $command"; fi
  done
  if [ "$(id -u)" -ne 0 ]; then
    echo "root, for a clean root"
  elif ! unshare --mount --pid --fork true 2>/dev/null; then
    echo "rights to unshare mounts"
  fi
  if [ -z "$(mirror)" ]; then
    echo "a mirror of Debian 12 among the sources of apt"
  elif command -v wget >/dev/null && ! wget -q --timeout=20 --tries=2 --spider "$(mirror)dists/bookworm/Release"; then
    echo "a mirror of Debian 12 that answers"
  fi
}

# The first mirror of Debian 12 that apt of this machine reads.
mirror() {
  # shellcheck disable=SC2016  # apt-get replaces these names
  apt-get indextargets --format '$(CODENAME) $(COMPONENT) $(CREATED_BY) $(REPO_URI)' 2>/dev/null |
    awk '$1 == "bookworm" && $2 == "main" && $3 == "Packages" { print $4; exit }'
}

if [ "${1:-}" = --lacks ]; then
  missing=$(lacking)
  if [ -z "$missing" ]; then exit 1; fi
  printf 'package: lacks %s\n' "${missing//$'\n'/, }" >&2
  exit
fi

say() { printf '%s\n' "-- $*"; }
failed=0
fail() {
  printf 'FAILED: %s\n' "$*"
  failed=1
}

work=$(mktemp -d)
clean=$work/root
trap 'rm -rf --one-file-system "$work"' EXIT
chmod 755 "$work"

say "the package"
if ! cpack --config "$build/CPackConfig.cmake" -B "$work/package" >"$work/cpack.log" 2>&1; then
  cat "$work/cpack.log"
  exit 1
fi
deb=$(echo "$work"/package/*.deb)
dpkg-deb -f "$deb"
version=$(dpkg-deb -f "$deb" Version)

say "lintian: no error but that no licence is chosen"
lintian --allow-root --tag-display-limit 0 "$deb" >"$work/lintian.log" 2>&1 || true
cat "$work/lintian.log"
if grep '^E:' "$work/lintian.log" | grep -v 'copyright\|license'; then fail "lintian has errors"; fi
if ! grep -q '^[EWI]:\|^N:' "$work/lintian.log" && [ -s "$work/lintian.log" ]; then fail "lintian did not end well"; fi

say "desktop entry, AppStream, file types, manual page, completions"
tree=$work/tree
dpkg-deb -x "$deb" "$tree"
share=$tree/usr/share
desktop-file-validate "$share/applications/shadow-inspector.desktop" || fail "desktop-file-validate"
# The file names no licence of its own, and its owner has no domain for a name.
appstreamcli validate --no-net --no-color "$share/metainfo/shadow-inspector.metainfo.xml" >"$work/appstream.log" || true
cat "$work/appstream.log"
if grep '^[EW]:' "$work/appstream.log" | grep -v 'metadata-license-missing\|cid-desktopapp-is-not-rdns'; then
  fail "appstreamcli validate"
fi
grep -q '^[EWI]:' "$work/appstream.log" || fail "appstreamcli printed nothing"
if MANWIDTH=100 man --warnings -l "$share/man/man1/shadow-inspector.1.gz" 2>&1 >/dev/null | grep .; then
  fail "the manual page has errors"
fi
bash -n "$share/bash-completion/completions/shadow-inspector" || fail "completions for bash"
zsh -n "$share/zsh/vendor-completions/_shadow-inspector" || fail "completions for zsh"
fish --no-execute "$share/fish/vendor_completions.d/shadow-inspector.fish" || fail "completions for fish"
if grep -rlF "$root" "$tree"; then fail "the package names the folder that it was built in"; fi

say "a clean root of Debian 12"
if ! debootstrap --variant=minbase bookworm "$clean" "$(mirror)" >"$work/debootstrap.log" 2>&1; then
  tail -5 "$work/debootstrap.log"
  fail "debootstrap"
  exit 1
fi
inside() {
  unshare --mount --pid --fork --mount-proc="$clean/proc" -- env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    HOME=/tmp/home XDG_CACHE_HOME=/tmp/home LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    ${http_proxy:+http_proxy="$http_proxy"} chroot "$clean" "$@"
}
# The caches of desktops, which have entries of the package while it is installed.
needs="$(dpkg-deb -f "$deb" Depends), shared-mime-info, desktop-file-utils, hicolor-icon-theme"
cp -r /etc/apt/apt.conf.d/. "$clean/etc/apt/apt.conf.d/" 2>/dev/null || true
if ! { inside apt-get update -q && inside apt-get satisfy -y -q --no-install-recommends "$needs"; } >"$work/apt.log" 2>&1; then
  tail -20 "$work/apt.log"
  fail "what the package depends on cannot be installed"
  exit 1
fi
# All files, but those of dpkg and apt themselves, and what programs that run leave in their own folders.
files() {
  local folder without=()
  for folder in proc dev sys tmp var/log var/cache var/lib/dpkg; do without+=(-path "./$folder" -prune -o); done
  (cd "$clean" && find . "${without[@]}" -printf '%p %y %m %u %l\n' | sort)
}
files >"$work/before"
cp "$deb" "$clean/tmp/package.deb"
mkdir -p "$clean/tmp/home"
inside dpkg -i /tmp/package.deb >"$work/dpkg.log" 2>&1 || { cat "$work/dpkg.log"; fail "dpkg -i"; }
files >"$work/installed"
say "installed: $(comm -13 "$work/before" "$work/installed" | wc -l) files and folders"

say "run there"
expect() { # WHAT TEXT COMMAND...: the output of a command in the clean root has a text
  local what=$1 text=$2 out
  shift 2
  out=$(inside "$@" 2>&1) || { fail "$what: $out"; return; }
  grep -qF -- "$text" <<<"$out" || fail "$what: '$text' is not in: $out"
}
expect "--version" "shadow-inspector $version" shadow-inspector --version
expect "info" "driver " shadow-inspector info
expect "list" "acne" shadow-inspector list presets
expect "render" "" shadow-inspector render stage --preset acne --size 320x180 -o /tmp/stage.png
expect "probe" "verdict" shadow-inspector probe stage --size 320x180 --pixel 160,90
if [ "$(head -c 4 "$clean/tmp/stage.png" 2>/dev/null | tail -c 3)" != PNG ]; then fail "render wrote no picture"; fi
if [ -n "${1:-}" ]; then cp "$clean/tmp/stage.png" "$1"; fi
grep -q 'application/x-shadow-inspector-bundle' "$clean/usr/share/mime/globs2" || fail "the type of bundles is unknown"
grep -q 'application/x-renderdoc-capture' "$clean/usr/share/mime/globs2" || fail "the type of captures is unknown"
grep -q 'shadow-inspector.desktop' "$clean/usr/share/applications/mimeinfo.cache" || fail "no type opens the program"

say "removed"
inside dpkg --purge shadow-inspector >>"$work/dpkg.log" 2>&1 || { cat "$work/dpkg.log"; fail "dpkg --purge"; }
files >"$work/after"
if ! diff "$work/before" "$work/after"; then fail "the package left traces"; fi
if [ $failed -ne 0 ]; then exit 1; fi
say "the package passes"
