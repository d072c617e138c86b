#!/usr/bin/env python3
"""Makes a program's completions for bash and zsh, and its manual page, from what it prints for --help.

usage: program_words.py PROGRAM FOLDER

Writes FOLDER/bash-completion/completions/NAME, FOLDER/zsh/vendor-completions/_NAME and FOLDER/man/man1/NAME.1.gz. The
page comes from help2man; the help of subcommands is a section of it.
"""

import gzip
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

COMMANDS_MAX = 200  # of a program; above, it is taken to print the same help for any word


def help_of(program, words):
    """What the program prints, in an environment that says nothing of this machine."""
    environment = {"PATH": os.environ["PATH"], "HOME": "/nonexistent", "LANG": "C.UTF-8"}
    said = subprocess.run([program, *words, "--help"], env=environment, stdout=subprocess.PIPE, check=True, timeout=60)
    return said.stdout.decode()


class Command:
    """A program or one of its subcommands: its options with their words, their choices, its subcommands."""

    def __init__(self, text):
        self.text = text
        self.options, self.choices, self.commands = {}, {}, {}
        section, names = "", []
        for line in text.splitlines():
            if re.match(r"\S.*:$", line):
                section = line
            option = re.match(r"  (-\S+)(.*)$", line)
            command = re.match(r"  (\S+)\s+(\S.*)$", line)
            words = re.match(r" {20,}(\S.*)$", line)
            if option:
                names = [name.split("{")[0] for name in option[1].split(",")]
                self.options |= dict.fromkeys(names, "")
                given = re.search(r":\{([^}]*)\}", option[2])
                if given:
                    self.choices |= dict.fromkeys(names, given[1].split(","))
                said = re.search(r"\s{2,}(\S.*)$", option[2])
                self.describe(names, said[1] if said else "")
            elif section.startswith("Subcommands") and command:
                self.commands[command[1]] = command[2]
                names = []
            elif words:
                self.describe(names, words[1])

    def describe(self, names, words):
        for name in names:
            self.options[name] = self.options[name] or words


def commands_of(program):
    """All commands by their words, the program itself first."""
    found = {}
    waiting = [()]
    while waiting:
        words = waiting.pop(0)
        found[words] = Command(help_of(program, words))
        waiting += [(*words, name) for name in found[words].commands]
        if len(found) > COMMANDS_MAX:
            sys.exit(f"{program} has more than {COMMANDS_MAX} commands")
    return found


def quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def cases(commands, render):
    """A line of a shell's `case` for each command for which there is something to say."""
    return "".join(f"    {quoted(' '.join(words))}) {render(commands[words])} ;;\n" for words in commands)


def choice_cases(commands):
    lines = ""
    for words, command in commands.items():
        for name, values in command.choices.items():
            lines += f"    {quoted(' '.join([*words, name]))}) choices={quoted(' '.join(values))} ;;\n"
    return lines


def steps(commands):
    """The patterns of `WORDS WORD` that lead into a subcommand."""
    return "|".join(quoted(" ".join(words)) for words in commands if words)


def bash(name, commands):
    function = "_" + name.replace("-", "_")
    walk = f"""
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${{at:+$at }}${{COMP_WORDS[i]}}
    case $word in
    {steps(commands)}) at=$word ;;
    esac
  done""" if steps(commands) else ""
    return f"""# Completion of {name} in bash, made from its --help.
{function}() {{
  local at='' word='' options='' names='' choices='' i=0
  local current=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}}{walk}
  case ${{at:+$at }}$previous in
{choice_cases(commands)}    *) ;;
  esac
  case $at in
{cases(commands, lambda c: f"options={quoted(' '.join(c.options))} names={quoted(' '.join(c.commands))}")}  esac
  if [[ -n $choices ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$current")
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -W "$names" -- "$current")
  fi
}}
complete -o bashdefault -o default -F {function} {name}
"""


def described(entries):
    """An array's elements for _describe, `name:words`; colons of a name would end it."""
    return " ".join(quoted(name.replace(":", "\\:") + (":" + words if words else "")) for name, words in entries.items())


def zsh(name, commands):
    walk = f"""
  for word in ${{words[2,CURRENT-1]}}; do
    word=${{at:+$at }}$word
    case $word in
    {steps(commands)}) at=$word ;;
    esac
  done""" if steps(commands) else ""
    return f"""#compdef {name}
# Completion of {name} in zsh, made from its --help.
_{name.replace("-", "_")}() {{
  local at='' word='' choices=''
  local -a options names{walk}
  case ${{at:+$at }}${{words[CURRENT-1]}} in
{choice_cases(commands)}    *) ;;
  esac
  case $at in
{cases(commands, lambda c: f"options=({described(c.options)}) names=({described(c.commands)})")}  esac
  if [[ -n $choices ]]; then
    compadd -- ${{=choices}}
  elif [[ $PREFIX == -* ]]; then
    _describe -o option options
  else
    (( $#names )) && _describe command names
    _files
  fi
}}
_{name.replace("-", "_")} "$@"
"""


def roff(text):
    lines = text.replace("\\", "\\e").replace("-", "\\-").splitlines()
    return "\n".join("\\&" + line if line[:1] in (".", "'") else line for line in lines)


def page(program, name, commands):
    """The manual page by help2man: NAME from the help's first line, and a section of all subcommands' help."""
    parts = [f'.SS "{" ".join([name, *words])}"\n.nf\n{roff(command.text.strip())}\n.fi\n'
             for words, command in commands.items() if words]
    summary = re.split(r"[.:;](?:\s|$)", commands[()].text.strip())[0]
    with tempfile.NamedTemporaryFile("w", suffix=".h2m") as include:
        include.write("\n".join(["[subcommands]", *parts]))
        include.flush()
        more = ["--include=" + include.name] if parts else []
        said = subprocess.run(["help2man", "--no-info", "--section=1", "--name=" + summary[0].lower() + summary[1:], *more,
                               program], env=os.environ | {"HOME": "/nonexistent"}, stdout=subprocess.PIPE, check=True)
    return said.stdout


def write(path, data):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def main():
    program, folder = sys.argv[1], Path(sys.argv[2])
    name = Path(program).name
    commands = commands_of(program)
    write(folder / "bash-completion/completions" / name, bash(name, commands).encode())
    write(folder / "zsh/vendor-completions" / ("_" + name), zsh(name, commands).encode())
    write(folder / "man/man1" / (name + ".1.gz"), gzip.compress(page(program, name, commands), 9, mtime=0))


if __name__ == "__main__":
    main()
