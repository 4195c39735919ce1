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

# duration SECONDS: "1 min 20 s".
duration() {
  if [ "$1" -ge 60 ]; then printf '%d min %d s' $(($1 / 60)) $(($1 % 60)); else printf '%d s' "$1"; fi
}

# tell_progress WHAT [PART]: reads numbers from 0 to 100, one a line, and says every ten seconds how far WHAT is. Where
# the numbers count parts that differ much in length (PART: their name), it says no time left.
tell_progress() {
  local what=$1 part=${2:-} start=$SECONDS next=$((SECONDS + 10)) percent=0 line begun="" status
  while true; do
    status=0
    read -r -t 2 line || status=$?
    if [ "$status" = 0 ]; then line=$begun$line percent=${line%%.*} begun=""
    elif [ "$status" -le 128 ]; then return
    else begun=$begun$line  # the two seconds ended within a line
    fi
    [ "$SECONDS" -lt "$next" ] && continue
    next=$((SECONDS + 10))
    local elapsed=$((SECONDS - start)) left=""
    [ -z "$part" ] && [ "${percent:-0}" -gt 0 ] && left=", about $(duration $((elapsed * (100 - percent) / percent))) left"
    say "$what: ${percent:-0} %${part:+ of the $part} after $(duration "$elapsed")$left"
  done
}

# tell_tests: reads what ctest says and passes it on, but for the lines about suites that begin and that pass: a line
# every ten seconds says how far the tests are.
tell_tests() {
  local line result='^ *([0-9]+)/([0-9]+) Test +#[0-9]+: [^ ]+ \.* +'
  while IFS= read -r line || [ -n "$line" ]; do
    [[ $line =~ $result ]] && echo $((100 * BASH_REMATCH[1] / BASH_REMATCH[2])) >&3
    [[ $line =~ ^\ *Start\ +[0-9]+:|$result"Passed" ]] || printf '%s\n' "$line"
  done 3> >(tell_progress Testing suites)
}

# purpose_text PURPOSE: why the packages of this purpose are wanted.
purpose_text() {
  case $1 in
    build) echo "to build dynlab" ;;
    run) echo "to draw figures, make documents and keep strangers' scripts apart" ;;
    test) echo "to test it" ;;
    fuzz) echo "to feed it mutated inputs" ;;
    package) echo "to make a package of it" ;;
    cluster) echo "to test work on several machines" ;;
    web) echo "to build it for browsers" ;;
    *) echo "for its $1" ;;
  esac
}

# missing_packages PURPOSE: the packages of scripts/packages.txt for this purpose that are not installed.
missing_packages() {
  comm -23 <(awk -v purpose="$1" '$1 == purpose {for (i = 2; i <= NF; i++) print $i}' "$project/scripts/packages.txt" | sort -u) \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' 2>/dev/null | awk '$1 == "installed" {print $2}' | sort -u)
}

# install_packages PURPOSE...: the packages for these purposes, those only that are missing.
# Container images are often told to leave out /usr/share/doc, where the measured records of libslicot-doc lie.
install_packages() {
  local purpose missing all=""
  for purpose in "$@"; do
    missing=$(missing_packages "$purpose" | tr '\n' ' ')
    [ -z "${missing// /}" ] && continue
    [ -z "$all" ] && say "Installing from Debian"
    say "  $(purpose_text "$purpose"): $missing"
    all+=" $missing"
  done
  [ -z "$all" ] && return
  command -v apt-get >/dev/null ||
    { say "dynlab installs its parts with apt-get, which this system does not have."; return 1; }
  local log; log=$(mktemp)
  # apt-get tells how far it is on descriptor 3: first what is fetched, then what is set up.
  if ! { as_root apt-get update >"$log" 2>&1 &&
         { as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends \
             -o APT::Status-Fd=3 -o Dpkg::Options::=--path-include='/usr/share/doc/libslicot-doc/*' $all \
             3>&1 >>"$log" 2>&1 |
           while IFS=: read -r kind _ percent _; do
             case $kind in
               dlstatus) echo $((${percent%.*} / 2)) ;;
               pmstatus) echo $((50 + ${percent%.*} / 2)) ;;
             esac
           done | tell_progress "Installing"; [ "${PIPESTATUS[0]}" = 0 ]; }; }; then
    tail -n 15 "$log" >&2; rm -f "$log"
    say "The packages could not be installed; the last lines of apt-get stand above."
    return 1
  fi
  rm -f "$log"
}

# build FOLDER CMAKE-OPTION...: configures and builds below build/; says how far it is, all else only when something fails.
build() {
  local folder=$project/build/$1 log; shift
  mkdir -p "$folder"
  log=$folder/build.log
  cmake -S "$project" -B "$folder" -G Ninja "$@" >"$log" 2>&1 || { cat "$log" >&2; return 1; }
  if [ -t 2 ]; then cmake --build "$folder" -j "$(nproc)" ${targets:+--target $targets} >&2; return; fi
  # Ninja's lines begin with what is done in percent.
  NINJA_STATUS='%p ' cmake --build "$folder" -j "$(nproc)" ${targets:+--target $targets} 2>&1 | tee "$log" |
    sed -u -n 's/^ *\([0-9]*\)% .*/\1/p' | tell_progress "Building"
  [ "${PIPESTATUS[0]}" = 0 ] || { grep -v '^ *[0-9]*% ' "$log" | tail -n 200 >&2; return 1; }
}

# What scripts/start and scripts/test build: fast as a whole, for this machine's processor.
release_options=(-DCMAKE_BUILD_TYPE=Release -DDYNLAB_NATIVE=ON -DDYNLAB_UNITY=ON)
sanitize_options=(-DCMAKE_BUILD_TYPE=Debug -DDYNLAB_SANITIZE=ON -DDYNLAB_UNITY=ON)

# debian_sources FOLDER PACKAGE...: the sources of Debian packages, unpacked in FOLDER, from where the system gets its packages.
# Lists of sources are made for these calls: the system's settings stay as they are.
debian_sources() {
  local folder=$1 lists=$1/lists package file; shift
  mkdir -p "$lists/partial" "$lists/parts"
  for file in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
    case $file in
      *.sources) sed 's/^Types:.*/Types: deb-src/' "$file" ;;
      *) ! [ -e "$file" ] || sed -n 's/^deb /deb-src /p' "$file" ;;
    esac >"$lists/parts/$(basename "$file")"
  done
  local apt=(-q -o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$lists/parts" -o "Dir::State::lists=$lists"
             -o APT::Sandbox::User=root)
  for package; do
    [ -e "$folder/$package.done" ] && continue
    (cd "$folder" && { [ -e lists/updated ] || { apt-get "${apt[@]}" update && touch lists/updated; } &&
      download_source "$package" && tar xf "$package"_*.orig.tar.* && touch "$package.done"; } >log 2>&1) ||
      { tail -n 5 "$folder/log" >&2; say "The source of Debian's package $package could not be fetched."; return 1; }
  done
}

# download_source PACKAGE: its newest version whose files are there. A mirror's index can name a version that the mirror no longer has
# or does not have yet. For debian_sources, whose options of apt it takes.
download_source() {
  local version
  for version in $(apt-cache "${apt[@]}" showsrc --only-source "$1" | sed -n 's/^Version: //p' | sort -ruV); do
    rm -f "$1"_*
    apt-get "${apt[@]}" source --download-only "$1=$version" && return
  done
  return 1
}

# build_web: the engine as WebAssembly, in build/web/engine.
build_web() {
  local folder=$project/build/web
  debian_sources "$folder/sources" lua5.4 re2 libsodium zlib
  # Emscripten's own libraries are built once into a copy of its cache that may be written to.
  export EM_CACHE=$folder/cache EM_FROZEN_CACHE=0 NODE_PATH=/usr/share/nodejs
  [ -d "$EM_CACHE" ] || cp -a /usr/share/emscripten/cache "$EM_CACHE"
  local log=$folder/build.log
  cmake -S "$project/engine/web" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSOURCES="$folder/sources" \
    --toolchain /usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake >"$log" 2>&1 || { tail -n 30 "$log" >&2; return 1; }
  NINJA_STATUS='%p ' cmake --build "$folder" -j "$(nproc)" 2>&1 | tee "$log" | sed -u -n 's/^ *\([0-9]*\)% .*/\1/p' |
    tell_progress "Building for browsers"
  [ "${PIPESTATUS[0]}" = 0 ] || { grep -v '^ *[0-9]*% ' "$log" | tail -n 100 >&2; return 1; }
}
