# bytes_literal(<variable> <file>): the bytes of a file as a C++ string literal. One compiles many times faster than an array of
# numbers, and needs no assembler.
function(bytes_literal variable file)
  file(SIZE ${file} size)
  file(READ ${file} bytes HEX)
  # Eight bytes a match, as matches are what costs time; those added to fill the last are not part of what the size says.
  math(EXPR missing "(8 - ${size} % 8) % 8")
  string(REPEAT 00 ${missing} filling)
  string(APPEND bytes ${filling})
  string(REGEX REPLACE "(..)(..)(..)(..)(..)(..)(..)(..)"
    "\\\\x\\1\\\\x\\2\\\\x\\3\\\\x\\4\\\\x\\5\\\\x\\6\\\\x\\7\\\\x\\8" bytes "${bytes}")
  set(${variable} "\"${bytes}\"" PARENT_SCOPE)
endfunction()
