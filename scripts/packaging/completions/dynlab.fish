# NextWords for fish: dynlab itself knows what may stand next (see engine/cli/pages/next_words.h).
function __dynlab_offered
    set -l words (commandline -opc) (commandline -ct)
    for line in (dynlab complete -- $words[2..-1] 2>/dev/null)
        if test $line = :files
            __fish_complete_path (commandline -ct)
        else
            echo $line
        end
    end
end
complete -c dynlab -f -a '(__dynlab_offered)'
