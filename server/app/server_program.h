// scree-server: parses its options, runs a LiveServer until a signal or its end, and reports.
#pragma once

namespace scree {

/// All of main(), which compiles in no time without it. Returns the exit status.
int server_program(int argc, char** argv);

}  // namespace scree
