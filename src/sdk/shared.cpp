// The shared library is all of the static one; a target needs a source of its own.
