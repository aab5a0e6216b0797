
# The load cases of the case files on the line.
_orthostat_load_cases() {
    local each
    for each in "${COMP_WORDS[@]}"; do
        [[ $each == *.y*ml && -f $each ]] || continue
        sed -n '/^cases:/,/^[a-z]/{/^cases:/p;/^[^a-z]/p}' "$each" | grep -oE '(^|[-{ ,])name: *[A-Za-z0-9_.-]+' | sed 's/.*name: *//'
    done
}

# What `verify` finds by name; the cases are installed near this file.
_orthostat_cases=${BASH_SOURCE[0]%/*}/../../orthostat/cases
_orthostat_verified() {
    local each
    for each in "${ORTHOSTAT_CASES:-$_orthostat_cases}"/verify/*.yaml; do
        [ -e "$each" ] || continue
        each=${each##*/}
        echo "${each%.yaml}"
    done
}

# The words that may stand next: commands, then options, case files, and the files that options write.
_orthostat() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command= i
    COMPREPLY=()
    for ((i = 1; i < COMP_CWORD; i++)); do
        case ${COMP_WORDS[i]} in
        -n) ((i++)) ;; # scripts/orthostat -n RANKS
        -*) ;;
        *) command=${COMP_WORDS[i]} && break ;;
        esac
    done
    if [ -z "$command" ]; then
        mapfile -t COMPREPLY < <(compgen -W "$_orthostat_commands --help --version --quiet --verbose" -- "$word")
        return
    fi
    local options=${_orthostat_options[$command]-}
    if [ "$word" = = ]; then # --json=, which readline takes apart
        word=
    elif [ "$before" = = ]; then
        before=${COMP_WORDS[COMP_CWORD - 2]}
    fi
    if [[ $word == -?* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
        [[ ${COMPREPLY[0]-} != *= ]] || compopt -o nospace 2>/dev/null
        return
    fi
    compopt -o filenames 2>/dev/null
    if [[ " ${_orthostat_values[$command]-} " == *" $before "* ]]; then
        if [[ " ${_orthostat_files[$command]-} " == *" $before "* ]]; then # none of them reads a case
            mapfile -t COMPREPLY < <(compgen -f -X '*.y*ml' -- "$word")
        elif [ "$before" = --case ]; then
            mapfile -t COMPREPLY < <(compgen -W "$(_orthostat_load_cases)" -- "$word")
        fi
        return
    fi
    case ${_orthostat_takes[$command]-} in
    '[NAME...]')
        mapfile -t COMPREPLY < <(compgen -W "$(_orthostat_verified)" -- "$word"; compgen -f -X '!*.y*ml' -- "$word"; compgen -d -- "$word")
        ;;
    *CASE*) mapfile -t COMPREPLY < <(compgen -f -X '!*.y*ml' -- "$word"; compgen -d -- "$word") ;;
    '') ;;
    *) mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
    esac
}
complete -F _orthostat orthostat scripts/orthostat
