#!/bin/sh
# The demos for Windows, made on Linux: build/windows, and the same as build/rt-windows.zip. They run
# on any PC. SDL for Windows comes from PyPI (pysdl2-dll), the headers are this system's. Status 3:
# a tool or SDL is missing.
build=${BUILD:-build}
parts=$build/windows-parts
need() { # TOOL PACKAGE
    command -v "$1" >/dev/null || { echo "note: $1 is missing (Debian: apt-get install $2)"; exit 3; }
}
need x86_64-w64-mingw32-gcc gcc-mingw-w64-x86-64
need python3 python3-pip
need pkg-config pkg-config
need zip zip
cc=$(command -v x86_64-w64-mingw32-gcc-posix || echo x86_64-w64-mingw32-gcc) # Debian has two: threads

mkdir -p "$parts/SDL2" || exit
[ -f "$parts/SDL2.dll" ] || {
    python3 -m pip download -q --no-deps --only-binary=:all: --platform win_amd64 -d "$parts" pysdl2-dll ||
        { echo "note: no SDL for Windows from PyPI (pysdl2-dll)"; exit 3; }
    python3 -m zipfile -e "$parts"/pysdl2_dll-*.whl "$parts/wheel" &&
        cp "$parts"/wheel/sdl2dll/dll/SDL2.dll "$parts"/wheel/sdl2dll/dll/SDL2_ttf.dll "$parts" || exit
}

# The headers know Windows, but for the one that describes this system.
cp "$(pkg-config --variable=includedir sdl2)"/SDL2/*.h "$parts/SDL2" || exit
cat >"$parts/SDL2/SDL_config.h" <<'END'
#include "SDL_platform.h"
#define SIZEOF_VOIDP 8
#define HAVE_STDARG_H 1
#define HAVE_STDDEF_H 1
#define HAVE_STDINT_H 1
END

font=$(.ci/deps font "$cc")
sdl="-isystem $parts/SDL2"
libs="-static $parts/SDL2.dll" # of this file only the names are taken
rm -rf "$build/windows" && mkdir -p "$build/windows" || exit
cp "$parts/SDL2.dll" "$build/windows" || exit
if [ -f "$parts/SDL2/SDL_ttf.h" ] && [ -n "$font" ]; then
    sdl="$sdl -DHAVE_TTF '-DFONT=\"$(basename "$font")\"'"
    libs="$libs $parts/SDL2_ttf.dll"
    cp "$parts/SDL2_ttf.dll" "$font" "$build/windows" || exit
fi
demos=$(ls demos/demo[0-9]*.c | sed "s|demos/\(demo[0-9]*\)_.*|$parts/\1|")
make -s BUILD="$parts" CC="$cc" MACHINE= MPICC= OPENMP=-fopenmp SDL="$sdl" ASSIMP= LIBS="$libs" $demos || exit
for demo in $demos; do
    cp "$demo.exe" "$build/windows" || exit
done
sed 's/$/\r/' >"$build/windows/README.txt" <<'END'
The demos of rt.h, a ray tracer in one C header. Unpack the folder; keep its files together.
A double click on demo01.exe to demo18.exe opens a chapter's picture in a window: h shows the keys.
If Windows warns of a program that it does not know: More info, Run anyway.
In a terminal: demo09.exe 1280 960 --samples 64 (demo09.exe --help lists what there is).
The picture is written beside the program, demo09.png for demo09.exe, or where --out says.
END
rm -f "$build/rt-windows.zip"
(cd "$build" && zip -qr rt-windows.zip windows) && echo "$build/rt-windows.zip"
