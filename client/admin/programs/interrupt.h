// Ctrl-C in the console ends what a line does, and not the program. Any thread.
#pragma once

#include <string>

namespace scree {

/// From now on a Ctrl-C (SIGINT) is only noted.
void note_interrupts();
/// Whether one has come since forget_interrupt().
bool was_interrupted();
void forget_interrupt();
/// A line that somebody types. False: the input has ended, or an interrupt came before the line.
bool read_line_unless_interrupted(std::string& line);

}  // namespace scree
