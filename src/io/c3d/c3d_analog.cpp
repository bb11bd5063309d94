// Decodes analog samples with the scales and offsets in the parameters.
#include "io/c3d/c3d_analog.hpp"

#include "io/text/text.hpp"

namespace kinemend {

namespace {

std::vector<double> per_channel(const C3dDocument& document, const char* name, double otherwise) {
  std::vector<double> values = document.parameters.numbers("ANALOG", name);
  values.resize(document.layout.analog_count, otherwise);
  return values;
}

}  // namespace

C3dAnalogDecoder::C3dAnalogDecoder(const C3dDocument& document)
    : document_(document),
      is_unsigned_(equal_ignoring_case(document.parameters.text("ANALOG", "FORMAT"), "UNSIGNED")),
      // Some writers call it OFFSETS.
      offsets_(per_channel(document,
                           document.parameters.find("ANALOG", "OFFSET") ? "OFFSET" : "OFFSETS", 0)),
      scales_(per_channel(document, "SCALE", 1)) {
  for (double& offset : offsets_) offset += is_unsigned_ && offset < 0 ? 65536 : 0;
  const double general = document.parameters.number("ANALOG", "GEN_SCALE").value_or(1);
  for (double& scale : scales_) scale *= general;
}

void C3dAnalogDecoder::stored(std::size_t frame, std::vector<double>& values) const {
  const C3dLayout& layout = document_.layout;
  const char* const from = document_.bytes.data() + layout.data_begin +
                           frame * layout.frame_bytes() + layout.point_bytes();
  values.resize(layout.analog_values);
  with_words(document_.processor, [&](auto words) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const char* const p = from + i * layout.value_bytes();
      if (layout.is_float) {
        values[i] = words.real(p);
      } else {
        const std::uint16_t word = words.word(p);
        values[i] = is_unsigned_ ? word : static_cast<std::int16_t>(word);
      }
    }
  });
}

}  // namespace kinemend
