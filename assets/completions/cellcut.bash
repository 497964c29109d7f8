# Completion of the command `cellcut` for bash.
# Source it from ~/.bashrc, or let `cmake --install` put it where bash-completion looks.

# Files with one of the extensions, and folders on the way to them.
_cellcut_files() {
  local IFS=$'\n' extensions=$1
  COMPREPLY+=($(compgen -d -- "$cur"))
  COMPREPLY+=($(compgen -f -- "$cur" | grep -iE "\.($extensions)\$"))
  compopt -o filenames
}

_cellcut_words() { COMPREPLY+=($(compgen -W "$1" -- "$cur")); }

_cellcut_render() {
  case $prev in
    -o | --output) _cellcut_files 'exr|pfm|png' ;;
    --report) _cellcut_files 'json' ;;
    --environment) _cellcut_files 'exr|hdr' ;;
    --strategy) _cellcut_words 'uniform power proportional cell-cut point-cut light-tree' ;;
    --quality) _cellcut_words 'preview balanced accurate' ;;
    --in-cluster) _cellcut_words 'intensity descent' ;;
    --sampler) _cellcut_words 'sobol independent' ;;
    --punctual-scale) _cellcut_words 'blender' ;;
    --size) _cellcut_words '1280x720 1920x1080 3840x2160' ;;
    --spp | --time | --noise | --max-depth | --seed | --threads | --camera) ;;
    --environment-scale | --environment-rotation) ;;
    *)
      if [[ $cur == -* ]]; then
        _cellcut_words '-o --output --report --strategy --spp --time --noise --size --max-depth --seed --threads --camera
          --sampler --quality --threshold --max-cut --grid-resolution --in-cluster --cell-memory --environment --environment-scale --environment-rotation --punctual-scale --help'
      else
        _cellcut_files 'gltf|glb|obj'
      fi
      ;;
  esac
}

_cellcut_generate() {
  case $prev in
    -o | --output) _cellcut_files 'glb' ;;
    --lights | --seed) ;;
    generate) _cellcut_words 'rooms street hall kinds' ;;
    *) _cellcut_words '--lights --seed -o --output --help' ;;
  esac
}

_cellcut() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    _cellcut_words 'render compare generate info --help --version'
    return
  fi
  case ${COMP_WORDS[1]} in
    render) _cellcut_render ;;
    generate) _cellcut_generate ;;
    compare) if [[ $cur == -* ]]; then _cellcut_words '--help'; else _cellcut_files 'exr|pfm|hdr'; fi ;;
    info) if [[ $cur == -* ]]; then _cellcut_words '--help'; else _cellcut_files 'gltf|glb|obj'; fi ;;
  esac
}

complete -F _cellcut cellcut
