#!/usr/bin/env bash
# What `cmake --install` leaves in a folder is a program that renders from there, with its scenes and nothing else of the
# checkout.
#   install_test.sh BUILD
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$1" --prefix "$folder/usr" >/dev/null
cd "$folder"
ls usr/share/doc/cellcut/{README.md,CHANGELOG.md,LICENSE,copyright} usr/share/bash-completion/completions/cellcut
cellcut() { env -i HOME="$folder" "$folder/usr/bin/cellcut" "$@"; }
for scene in usr/share/cellcut/scenes/*.glb; do cellcut info "$scene" >/dev/null; done
cellcut render usr/share/cellcut/scenes/kinds.glb -o picture.exr --size 32x18 --spp 1
cellcut compare picture.exr picture.exr | grep '"mse": 0.0,'
