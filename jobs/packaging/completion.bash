# Completion of sphdrop's command line in bash: options, case files, folders, and the parameters of --set.
_sphdrop() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  COMPREPLY=()
  case $previous in
    --set)
      # The program itself knows its parameters.
      local parameters
      parameters=$("${COMP_WORDS[0]}" --list-parameters 2>/dev/null | awk 'NR > 1 && /^[^ ]/ { print $1 "=" }')
      mapfile -t COMPREPLY < <(compgen -W "$parameters" -- "$current")
      compopt -o nospace
      return ;;
    --output) mapfile -t COMPREPLY < <(compgen -d -- "$current") && return ;;
    --restart)
      mapfile -t COMPREPLY < <(compgen -W 'latest auto' -- "$current"; compgen -f -X '!*checkpoint_*.h5' -- "$current")
      return ;;
    --until | --max-walltime) return ;;
  esac
  if [[ $current == -* ]]; then
    local options
    options=$("${COMP_WORDS[0]}" --help 2>/dev/null | grep -oE -- '--[a-z][a-z-]+')
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current" | sort -u)
  else
    mapfile -t COMPREPLY < <(compgen -f -X '!*.cfg' -- "$current"; compgen -d -S / -- "$current")
    compopt -o nospace
  fi
}
complete -F _sphdrop sphdrop
