# Shared by the scripts beside it: installing packages and building. Sourced, not run.
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '%s\n' "$*" >&2; }

# as_root COMMAND...: directly as root, else with sudo.
as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"
  elif command -v sudo >/dev/null; then sudo "$@"
  else say "This needs an administrator: run it as root, or install sudo. Wanted: $*"; return 1
  fi
}

# install_packages PURPOSE...: the packages of scripts/packages.txt for these purposes, those only that are missing.
# Container images are often told to leave out /usr/share/doc, where the measured records of libslicot-doc lie.
install_packages() {
  local wanted missing
  wanted=$(awk -v purposes=" $* " '!/^#/ && index(purposes, " " $1 " ") {for (i = 2; i <= NF; i++) print $i}' \
    "$project/scripts/packages.txt")
  missing=$(comm -23 <(sort -u <<<"$wanted") \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' 2>/dev/null | awk '$1 == "installed" {print $2}' | sort -u))
  [ -z "$missing" ] && return
  command -v apt-get >/dev/null ||
    { say "dynlab installs its parts with apt-get, which this system does not have. Wanted:" $missing; return 1; }
  say "Installing from Debian:" $missing
  local log; log=$(mktemp)
  if ! { as_root apt-get update && as_root env DEBIAN_FRONTEND=noninteractive \
         apt-get install -y --no-install-recommends \
         -o Dpkg::Options::=--path-include='/usr/share/doc/libslicot-doc/*' $missing; } >"$log" 2>&1; then
    tail -n 15 "$log" >&2; rm -f "$log"
    say "The packages could not be installed; the last lines of apt-get stand above."
    return 1
  fi
  rm -f "$log"
}

# build FOLDER CMAKE-OPTION...: configures and builds below build/; quiet unless something fails or a terminal watches.
build() {
  local folder=$project/build/$1 log; shift
  mkdir -p "$folder"
  log=$folder/build.log
  cmake -S "$project" -B "$folder" -G Ninja "$@" >"$log" 2>&1 || { cat "$log" >&2; return 1; }
  if [ -t 2 ]; then cmake --build "$folder" >&2
  else cmake --build "$folder" >"$log" 2>&1 || { cat "$log" >&2; return 1; }
  fi
}
