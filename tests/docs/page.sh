# shellcheck shell=bash disable=SC2034  # the variables are for the scripts that source this
# Reads the commands of a page in Markdown; for run.sh and options.sh, which source this file.
#
# A page shows commands in blocks indented by four spaces. A comment before each block, which readers do not see, says
# what a test does with it:
#
#   <!-- run -->                      runs the block's commands, one after the other
#   <!-- run: together -->            runs them at the same time, and waits for all
#   <!-- run: without server -->      ends the page's server first
#   <!-- run: exits with N -->        the commands fail, with this exit status
#   <!-- not run: WHY -->             cannot run in a test; options.sh checks the options all the same
#   <!-- file: NAME -->               before a fenced block: writes it to this file
#
# Fenced blocks name their language, and are no commands.

# read_page FILE: calls on_command MARK COMMAND for each command, on_file NAME TEXT for each file, and on_fault LINE WHY.
# Lines that end with a backslash are one command with the next.
read_page() {
  local line number=0 mark='' state=text text='' command='' previous=''
  while IFS= read -r line || [[ -n $line ]]; do
    number=$((number + 1))
    case $state in
      fence)
        if [[ $line == '```' ]]; then
          state=text
          [[ $mark != 'file: '* ]] || on_file "${mark#file: }" "$text"
          mark=''
        else
          text+=$line$'\n'
        fi
        continue
        ;;
      block)
        if [[ $line == '    '* ]]; then
          command+=${command:+$'\n'}${line#    }
          [[ $line == *\\ ]] || { on_command "$mark" "$command" && command=''; }
          continue
        fi
        state=text
        mark=''
        ;;
    esac
    if [[ $line =~ ^'<!-- '((not )?run.*|file:\ .*)' -->'$ ]]; then
      mark=${BASH_REMATCH[1]}
      on_mark_fault "$number" "$mark"
    elif [[ $line == '```'* ]]; then
      [[ $line != '```' ]] || on_fault "$number" 'a fenced block names no language'
      [[ $line != '```sh' && $line != '```bash' && $line != '```console' ]] || on_fault "$number" 'commands are indented, not fenced'
      state=fence text=''
    elif [[ $line == '    '* && -z $previous ]]; then
      [[ $mark == run* || $mark == 'not run: '?* ]] || on_fault "$number" "no comment says how a test runs this command: $line"
      state=block command=${line#    }
      [[ $line == *\\ ]] || { on_command "$mark" "$command" && command=''; }
    elif [[ -n $line ]]; then
      [[ -z $mark ]] || on_fault "$number" "no command follows '$mark'"
      mark=''
    fi
    previous=$line
  done <"$1"
}

# A mark that page.sh does not know is a mistake.
on_mark_fault() {
  case $2 in
    run | 'run: together' | 'run: without server' | 'run: exits with '[1-9] | 'not run: '?* | 'file: '?*) ;;
    *) on_fault "$1" "there is no mark '$2'" ;;
  esac
}

# program_of COMMAND [ARGUMENTS]: sets program to the name in the build tree, consumed to the number of words that chose it,
# and subcommand to the program's own word for them. Fails where the command is the script's own.
program_of() {
  program=scree-$1 consumed=1 subcommand=()
  case "$1 ${2:-}" in
    'replay control') program=scree-admin consumed=2 subcommand=(replay) ;;
    'replay render') program=scree-render consumed=2 ;;
    'rules list' | 'rules reload' | 'rules console') program=scree-admin consumed=2 subcommand=(rules "$2") ;;
    'edge '*) program=scree-server ;;
    'bench studies') program=scree-studies consumed=2 ;;
    'bench paper' | 'bench matrix' | 'bench peers' | 'bench scale') program=scree-studies ;;
  esac
  case $1 in
    server | edge | viewer | bot | replay | world | scene | import | export | place | rules | admin | token | bench | pictures) ;;
    *) return 1 ;;
  esac
}
