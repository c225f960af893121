# Completion of mudline's commands, options, decks and names in bash. Installed it works by itself; from a build folder:
#   source apps/completion/mudline.bash
# Commands and options are those of the program's help, names those of `mudline list`.

# The program that the command line calls; nothing where that would have to be built first.
_mudline_program() {
  local called=$1 built
  built=$(dirname "$called")/build/release/apps/mudline/mudline
  if [ -x "$built" ]; then
    echo "$built"
  elif [ ! -e "$(dirname "$called")/CMakePresets.json" ]; then
    echo "$called"
  fi
}

# All words that may stand at place $1 of the line "$2 $3 ...", one in a line.
_mudline_words() {
  local at=$1 program=$2 command=$3 words=("${@:2}")
  local current=${words[at]}
  if [ "$at" -eq 1 ]; then
    "$program" --help | sed -n '/^Subcommands:/,/^[^ ]/s/^  \([a-z]\{1,\}\) .*/\1/p'
  elif [[ $current == -* ]]; then
    { "$program" --help; "$program" "$command" --help; } | grep -oE -- '(^|[ ,])--[a-z][a-z-]*' | tr -d ' ,'
  elif [ "$command" = explain ] || [ "$command" = template ]; then
    "$program" list | sed -n 's/^  \([^ ]\{1,\}\( [^ ]\{1,\}\)*\)  .*/\1/p'
  fi
}

_mudline() {
  local current=${COMP_WORDS[COMP_CWORD]} program word words
  COMPREPLY=()
  program=$(_mudline_program "$(command -v -- "${COMP_WORDS[0]}" || echo "${COMP_WORDS[0]}")")
  [ -n "$program" ] || return 0
  words=$(_mudline_words "$COMP_CWORD" "$program" "${COMP_WORDS[@]:1}" 2>/dev/null | sort -u)
  # a name of several words is one word of the line
  while IFS= read -r word; do
    if [ -n "$word" ] && [[ $word == "${current//[\\\"\']/}"* ]]; then COMPREPLY+=("$(printf %q "$word")"); fi
  done <<<"$words"
}

complete -o default -F _mudline mudline
