#compdef dynlab
# NextWords for zsh: dynlab itself knows what may stand next (see engine/cli/pages/next_words.h).
local -a offered
local word about files
while IFS=$'\t' read -r word about; do
  if [[ $word == :files ]]; then files=1; else offered+=("${word//:/\\:}:$about"); fi
done < <(dynlab complete -- "${(@)words[2,CURRENT]}" 2>/dev/null)
_describe -V dynlab offered
[[ -n $files ]] && _files
