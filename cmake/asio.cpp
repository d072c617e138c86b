// Asio's functions, compiled once; without it every source that includes Asio compiles them
// (ScreeTargets.cmake).
#include <asio/impl/src.hpp>
