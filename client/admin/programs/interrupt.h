// Ctrl-C in the console ends what a line does, and not the program. Any thread.
#pragma once

namespace scree {

/// From now on a Ctrl-C (SIGINT) is only noted.
void note_interrupts();
/// Whether one has come since forget_interrupt().
bool was_interrupted();
void forget_interrupt();

}  // namespace scree
