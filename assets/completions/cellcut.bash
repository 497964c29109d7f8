# Completion of the command `cellcut` for bash.
# Source it from ~/.bashrc, or let `cmake --install` put it where bash-completion looks.

# Files with one of the extensions, and folders on the way to them.
_cellcut_files() {
  local IFS=$'\n' extensions=$1
  COMPREPLY+=($(compgen -d -- "$cur"))
  COMPREPLY+=($(compgen -f -- "$cur" | grep -iE "\.($extensions)\$"))
  compopt -o filenames 2>/dev/null
}

_cellcut_words() { COMPREPLY+=($(compgen -W "$1" -- "$cur")); }

_cellcut_strategies='uniform power proportional cell-cut point-cut light-tree'
_cellcut_setting_options='--quality --size --max-depth --seed --threads --camera --sampler --threshold --max-cut
  --grid-resolution --in-cluster --cell-memory --environment --environment-scale --environment-rotation --punctual-scale
  --max-triangles --max-texture-bytes --help'
_cellcut_picture_options="--strategy --spp --time --noise $_cellcut_setting_options"

# Values of the options that say how a picture is made; fails for any other word.
_cellcut_picture_value() {
  case $prev in
    --environment) _cellcut_files 'exr|hdr' ;;
    --strategy) _cellcut_words "$_cellcut_strategies" ;;
    --quality) _cellcut_words 'preview balanced accurate' ;;
    --in-cluster) _cellcut_words 'intensity descent' ;;
    --sampler) _cellcut_words 'sobol independent' ;;
    --punctual-scale) _cellcut_words 'blender' ;;
    --size) _cellcut_words '1280x720 1920x1080 3840x2160' ;;
    --spp | --time | --noise | --max-depth | --seed | --threads | --camera | --threshold | --max-cut) ;;
    --grid-resolution | --cell-memory | --environment-scale | --environment-rotation) ;;
    --max-triangles | --max-texture-bytes) ;;
    *) return 1 ;;
  esac
}

_cellcut_scene_or() { if [[ $cur == -* ]]; then _cellcut_words "$1"; else _cellcut_files 'gltf|glb|obj'; fi; }

_cellcut_render() {
  case $prev in
    -o | --output) _cellcut_files 'exr|pfm|png' ;;
    --report) _cellcut_files 'json' ;;
    --quality) _cellcut_words 'preview balanced accurate auto' ;;
    *) _cellcut_picture_value || _cellcut_scene_or "-o --output --report $_cellcut_picture_options" ;;
  esac
}

_cellcut_measure() {
  case $prev in
    -o | --output) COMPREPLY+=($(compgen -d -- "$cur")) ;;
    --strategies) _cellcut_words "$_cellcut_strategies" ;;
    --reference) _cellcut_files 'exr|pfm|hdr' ;;
    --sweep)
      compopt -o nospace 2>/dev/null # the values follow
      _cellcut_words 'quality= threshold= max-cut= grid-resolution= in-cluster= max-depth='
      ;;
    --lights | --runs | --reference-spp) ;;
    measure) _cellcut_words 'rooms street hall kinds' && _cellcut_files 'gltf|glb|obj' ;;
    *) _cellcut_picture_value ||
      _cellcut_scene_or "-o --output --strategies --lights --sweep --time --spp --runs --reference --reference-spp
        --resume $_cellcut_setting_options" ;;
  esac
}

_cellcut_view() {
  case $prev in
    --reference) _cellcut_files 'exr|pfm|hdr' ;;
    --script | --record) _cellcut_files 'txt' ;;
    --gl) _cellcut_words 'egl osmesa' ;;
    --ui-scale) ;;
    *) _cellcut_picture_value ||
      _cellcut_scene_or "--ui-scale --reference --gl --headless --script --record $_cellcut_picture_options" ;;
  esac
}

_cellcut_screenshot() {
  case $prev in
    -o | --output) _cellcut_files 'png' ;;
    --reference) _cellcut_files 'exr|pfm|hdr' ;;
    --gl) _cellcut_words 'egl osmesa' ;;
    --overlay) _cellcut_words 'none touched visits cut-size estimate tree-depth variance samples error nan' ;;
    --overlay-scale) _cellcut_words 'linear log' ;;
    --colormap) _cellcut_words 'viridis turbo magma' ;;
    --split) _cellcut_words "$_cellcut_strategies" ;;
    --ui-scale | --overlay-range | --overlay-opacity | --pick) ;;
    *) _cellcut_picture_value ||
      _cellcut_scene_or "-o --output --no-ui --overlay --overlay-range --overlay-scale --overlay-opacity --colormap --grid
        --pick --split --ui-scale --reference --gl $_cellcut_picture_options" ;;
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
    _cellcut_words 'view screenshot render measure compare generate info --help --version'
    # The word view may be left out. Folders that are called as a verb begins do not come in its way.
    if [[ -z $cur || ${#COMPREPLY[@]} == 0 || $cur == -* ]]; then _cellcut_view; fi
    return
  fi
  case ${COMP_WORDS[1]} in
    view | -* | *.*) _cellcut_view ;;
    screenshot) _cellcut_screenshot ;;
    render) _cellcut_render ;;
    measure) _cellcut_measure ;;
    generate) _cellcut_generate ;;
    compare) if [[ $cur == -* ]]; then _cellcut_words '--help'; else _cellcut_files 'exr|pfm|hdr'; fi ;;
    info) if [[ $cur == -* ]]; then _cellcut_words '--max-triangles --max-texture-bytes --help'; else _cellcut_files 'gltf|glb|obj'; fi ;;
  esac
}

complete -F _cellcut cellcut
