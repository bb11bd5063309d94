// Reads the force plates of a C3D file: their corners, and the normal force from the analog
// channels of each.
#include <algorithm>
#include <cmath>
#include <optional>

#include "io/c3d/c3d_document.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

namespace {

// The normal force of a plate: weights of channels, from 0.
struct NormalForce {
  std::vector<std::size_t> channels;
  std::vector<double> weights;
};

// The channels of one plate of each type, and those of them that measure the normal force.
struct PlateType {
  std::size_t channels = 0;
  std::size_t first = 0, end = 0;  // summed, from 0
  bool is_calibrated = false;      // a matrix gives forces and moments from all channels
};

std::optional<PlateType> plate_type(double type) {
  if (type == 1 || type == 2) return PlateType{6, 2, 3, false};  // Fx, Fy, Fz, ...
  if (type == 3) return PlateType{8, 4, 8, false};               // ..., a force at each corner
  if (type == 4) return PlateType{6, 0, 6, true};
  if (type == 5) return PlateType{8, 0, 8, true};
  return std::nullopt;
}

class PlateReader {
 public:
  explicit PlateReader(const C3dDocument& document)
      : document_(document),
        channels_(document.parameters.numbers("FORCE_PLATFORM", "CHANNEL")),
        corners_(document.parameters.numbers("FORCE_PLATFORM", "CORNERS")),
        matrices_(document.parameters.numbers("FORCE_PLATFORM", "CAL_MATRIX")) {}

  // Returns the plates whose type, channels and corners are known, all with loads.
  std::vector<ForcePlate> read() const {
    std::vector<ForcePlate> plates;
    std::vector<NormalForce> forces;
    const std::size_t count = document_.parameters.count("FORCE_PLATFORM", "USED").value_or(0);
    const std::vector<double> types = document_.parameters.numbers("FORCE_PLATFORM", "TYPE");
    for (std::size_t p = 0; p < std::min(count, types.size()); ++p) {
      std::optional<NormalForce> force = force_of(p, types[p], std::min(count, types.size()));
      if (!force || corners_.size() < 12 * (p + 1)) continue;
      ForcePlate& plate = plates.emplace_back();
      for (std::size_t i = 0; i < 4; ++i) {
        const double* const at = corners_.data() + 12 * p + 3 * i;
        plate.corners[i] = {at[0], at[1], at[2]};
      }
      plate.rate_hz =
          document_.frame_rate_hz * static_cast<double>(document_.layout.analog_instants());
      forces.push_back(std::move(*force));
    }
    if (!plates.empty()) read_loads(forces, plates);
    return plates;
  }

 private:
  // The channels of all plates stand in one table, as wide as the plate with the most channels.
  std::optional<NormalForce> force_of(std::size_t plate, double type, std::size_t plates) const {
    const std::optional<PlateType> known = plate_type(type);
    if (!known || channels_.size() % plates != 0) return std::nullopt;
    const std::size_t width = channels_.size() / plates;
    if (width < known->channels) return std::nullopt;
    // The third row of a matrix stored by columns of six.
    const std::size_t rows = 6, fz = 2, matrix = rows * matrix_columns(plates);
    if (known->is_calibrated && matrix < rows * known->channels) return std::nullopt;
    NormalForce force;
    for (std::size_t i = known->first; i < known->end; ++i) {
      const double channel = channels_[plate * width + i];
      if (!(channel >= 1 && channel <= static_cast<double>(document_.layout.analog_count)))
        return std::nullopt;
      force.channels.push_back(static_cast<std::size_t>(channel) - 1);
      force.weights.push_back(known->is_calibrated ? matrices_[plate * matrix + rows * i + fz] : 1);
    }
    return force;
  }

  std::size_t matrix_columns(std::size_t plates) const {
    return matrices_.size() % (6 * plates) == 0 ? matrices_.size() / (6 * plates) : 0;
  }

  void read_loads(const std::vector<NormalForce>& forces, std::vector<ForcePlate>& plates) const {
    const C3dLayout& layout = document_.layout;
    const C3dAnalogDecoder decoder(document_);
    std::vector<double> stored;
    for (std::size_t f = 0; f < layout.frame_count; ++f) {
      decoder.stored(f, stored);
      for (std::size_t i = 0; i < layout.analog_instants(); ++i) {
        for (std::size_t p = 0; p < plates.size(); ++p) {
          double load = 0;
          for (std::size_t k = 0; k < forces[p].channels.size(); ++k) {
            const std::size_t channel = forces[p].channels[k];
            load += forces[p].weights[k] *
                    decoder.value(stored[i * layout.analog_count + channel], channel);
          }
          plates[p].loads.push_back(load);
        }
      }
    }
    for (ForcePlate& plate : plates) take_from_zero(plate.loads);
  }

  // Subtracts the mean of the frames without load, if the file names them, and turns loads upward:
  // files state the force on the plate or that on the foot.
  void take_from_zero(std::vector<double>& loads) const {
    const std::vector<double> range = document_.parameters.numbers("FORCE_PLATFORM", "ZERO");
    const auto instants = static_cast<double>(document_.layout.analog_instants());
    if (range.size() == 2 && range[1] >= 1 && range[0] >= 0 && range[1] >= range[0]) {
      const auto first = static_cast<std::size_t>((std::max(range[0], 1.0) - 1) * instants);
      const std::size_t end = std::min(loads.size(), static_cast<std::size_t>(range[1] * instants));
      double sum = 0;
      for (std::size_t i = first; i < end; ++i) sum += loads[i];
      for (double& load : loads) load -= first < end ? sum / static_cast<double>(end - first) : 0;
    }
    const auto [least, most] = std::minmax_element(loads.begin(), loads.end());
    if (least == loads.end() || -*least <= *most) return;
    for (double& load : loads) load = -load;
  }

  const C3dDocument& document_;
  std::vector<double> channels_, corners_, matrices_;
};

}  // namespace

std::vector<ForcePlate> force_plates(const Take& take) {
  const C3dOrigin origin = c3d_origin(take.source);
  if (origin.document == nullptr) return {};
  const C3dLayout& layout = origin.document->layout;
  if (layout.analog_count * layout.analog_instants() != layout.analog_values) return {};
  if (layout.analog_values == 0 || layout.frame_count == 0) return {};
  std::vector<ForcePlate> plates = PlateReader(*origin.document).read();
  for (ForcePlate& plate : plates) {
    for (Vec3& corner : plate.corners) corner = origin.change.moved(corner);
  }
  return plates;
}

}  // namespace kinemend
