// Live motion: frames as arrays in, cleaned frames out.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "conversions.hpp"
#include "held.hpp"
#include "kinemend/live.hpp"

namespace kinemend::python {

namespace {

using namespace py::literals;

class CoreStream {
 public:
  CoreStream(HeldCleanerPtr cleaner, const HeldTakePtr& like, double body_height,
             const std::string& source)
      : cleaner_(std::move(cleaner)),
        joints_(static_cast<py::ssize_t>(like->take.joint_count())),
        points_(static_cast<py::ssize_t>(like->take.point_count())),
        owners_(static_cast<py::ssize_t>(like->take.owner_count())),
        stream_(make_stream(*cleaner_->cleaner, like->take, body_height, parse_source(source))) {}

  std::size_t latency_frames() const { return stream_->latency_frames(); }

  py::object push(const std::optional<Numbers>& rotations, const Numbers& positions,
                  const std::optional<Marks>& observed) {
    const Frame in = frame_of_arrays(rotations, positions, observed);
    Frame out;
    bool has_frame = false;
    {
      const py::gil_scoped_release release;
      const std::lock_guard lock(mutex_);
      has_frame = stream_->push(in, out);
    }
    return has_frame ? arrays_of(out) : py::none();
  }
  py::object flush() {
    Frame frame;
    bool has_frame = false;
    {
      const py::gil_scoped_release release;
      const std::lock_guard lock(mutex_);
      has_frame = stream_->flush(frame);
    }
    return has_frame ? arrays_of(frame) : py::none();
  }
  void reset() {
    const std::lock_guard lock(mutex_);
    stream_->reset();
  }

 private:
  Frame frame_of_arrays(const std::optional<Numbers>& rotations, const Numbers& positions,
                        const std::optional<Marks>& observed) const {
    Frame frame;
    if (joints_ > 0) {
      if (!rotations) throw py::value_error("rotations: missing");
      check_shape(*rotations, {joints_, 4}, "rotations");
      frame.rotations = quats_of(*rotations);
    }
    check_shape(positions, {points_, 3}, "positions");
    frame.positions = vectors_of(positions);
    if (observed) {
      check_shape(*observed, {owners_}, "observed");
      frame.observed = marks_of(*observed);
    }
    return frame;
  }
  py::object arrays_of(const Frame& frame) const {
    Numbers rotations(std::vector<py::ssize_t>{joints_, 4});
    Numbers positions(std::vector<py::ssize_t>{points_, 3});
    py::array_t<bool> observed(owners_);
    std::copy(frame.rotations.begin(), frame.rotations.end(),
              reinterpret_cast<Quat*>(rotations.mutable_data()));
    std::copy(frame.positions.begin(), frame.positions.end(),
              reinterpret_cast<Vec3*>(positions.mutable_data()));
    bool* const marks = observed.mutable_data();
    for (py::ssize_t i = 0; i < owners_; ++i)
      marks[i] = frame.is_observed(static_cast<std::size_t>(i));
    return py::make_tuple(rotations, positions, observed);
  }

  HeldCleanerPtr cleaner_;
  py::ssize_t joints_, points_, owners_;
  std::unique_ptr<Stream> stream_;
  std::mutex mutex_;
};

}  // namespace

void bind_live(py::module_& module) {
  py::class_<CoreStream> type(module, "CoreStream", "A cleaner on one stream of frames.");
  type.def(py::init<HeldCleanerPtr, const HeldTakePtr&, double, const std::string&>(), "cleaner"_a,
           "like"_a, "body_height"_a, "source"_a);
  type.def_property_readonly("latency_frames", &CoreStream::latency_frames);
  type.def("push", &CoreStream::push, "rotations"_a, "positions"_a, "observed"_a);
  type.def("flush", &CoreStream::flush);
  type.def("reset", &CoreStream::reset);
}

}  // namespace kinemend::python
