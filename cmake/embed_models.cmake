# Writes OUTPUT, a C++ source that holds the model files of FOLDER as bytes.
#   cmake -DFOLDER=models -DOUTPUT=embedded_models.cpp -P embed_models.cmake
# A string literal compiles many times faster than an array of numbers, and needs no assembler.
file(GLOB files ${FOLDER}/*.kmodel)
list(SORT files)
set(text "// Made from models/*.kmodel by cmake/embed_models.cmake.\n#include \"priors/shipped_list.hpp\"\n\nnamespace kinemend {\n\nnamespace {\n\n")
string(APPEND text "#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n\nconstexpr EmbeddedModel table[] = {\n")
set(count 0)
foreach(file ${files})
  get_filename_component(method ${file} NAME_WE)
  file(SIZE ${file} size)
  file(READ ${file} bytes HEX)
  # Eight bytes a match, as matches are what costs time; those added to fill the last are not counted in the size.
  math(EXPR missing "(8 - ${size} % 8) % 8")
  string(REPEAT 00 ${missing} filling)
  string(APPEND bytes ${filling})
  string(REGEX REPLACE "(..)(..)(..)(..)(..)(..)(..)(..)"
    "\\\\x\\1\\\\x\\2\\\\x\\3\\\\x\\4\\\\x\\5\\\\x\\6\\\\x\\7\\\\x\\8" bytes "${bytes}")
  string(APPEND text "    {\"${method}\", \"${bytes}\", ${size}},\n")
  math(EXPR count "${count} + 1")
endforeach()
if(count EQUAL 0)
  string(APPEND text "    {\"\", \"\", 0},\n")
endif()
string(APPEND text "};\n\n}  // namespace\n\nconst EmbeddedModel* const embedded_models = table;\nconst std::size_t embedded_model_count = ${count};\n\n}  // namespace kinemend\n")
file(WRITE ${OUTPUT} "${text}")
