# bytes_literal(<variable> <file>): the bytes of a file as a C++ string literal. It compiles many times faster than an
# array of numbers and needs no assembler.
function(bytes_literal variable file)
  file(SIZE ${file} size)
  file(READ ${file} bytes HEX)
  # Converts eight bytes per match, because the number of matches determines the time. The stated size excludes the
  # bytes added to fill the last match.
  math(EXPR missing "(8 - ${size} % 8) % 8")
  string(REPEAT 00 ${missing} filling)
  string(APPEND bytes ${filling})
  string(REGEX REPLACE "(..)(..)(..)(..)(..)(..)(..)(..)"
    "\\\\x\\1\\\\x\\2\\\\x\\3\\\\x\\4\\\\x\\5\\\\x\\6\\\\x\\7\\\\x\\8" bytes "${bytes}")
  set(${variable} "\"${bytes}\"" PARENT_SCOPE)
endfunction()
