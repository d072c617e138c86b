#!/bin/sh
# Compiles the example by Mono: carve.exe beside this file, or at $1.
mcs -out:"${1:-carve.exe}" Carve.cs Scree.cs
