#include "io/amc.hpp"
#include "io/amc_document.hpp"
#include "io/asf.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

std::string write_amc(const Clip& clip) {
  const auto* document = dynamic_cast<const AmcDocument*>(clip.source.document.get());
  if (document == nullptr) throw Error(ErrorKind::usage, "the clip was not read from AMC");
  return document->bytes;
}

std::string write_asf(const Clip& clip) {
  const auto* document = dynamic_cast<const AmcDocument*>(clip.source.document.get());
  if (document == nullptr) throw Error(ErrorKind::usage, "the clip was not read from ASF");
  return document->asf_bytes;
}

}  // namespace kinemend
