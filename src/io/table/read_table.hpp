// Functions that readers of tables share: reading the bytes, and the frame rate of a table.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "io/table/marker_table.hpp"
#include "io/text/text.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

/// The statements of a table about its rate.
struct TableRate {
  double stated_hz;            ///< NaN or 0 if the file states no rate
  std::size_t stated_place;    ///< byte of the rate, or of its expected place
  std::size_t rows_place;      ///< byte of the first row
  double asked_hz;             ///< from the options; 0: not given
  double unknown_hz;           ///< the format's own guess
  std::string_view stated_by;  ///< name of the field: `DataRate`
  std::size_t mismatch_place;  ///< byte for reports of a mismatch with the times
  std::string_view missing;    ///< message if no usable rate is stated
  bool must_be_stated;         ///< whether using times or options instead is a repair too
};

/// Returns the stated rate, else the rate of the times, else the requested rate, else the guess.
/// Repairs: `frame_rate_unusable`, `time_mismatch`, `frame_rate_assumed`.
double table_rate(const SourceText& text, Diagnostics& diagnostics, const RowRate& times,
                  const TableRate& said);

/// Reads a table with `Reader(document, name, options).read()`, and keeps its bytes in the
/// `Document`, which becomes the take's source.
template <class Document, class Reader>
TakeResult read_table(std::string&& bytes, std::string_view name, std::string_view format,
                      const ReadOptions& options) {
  const auto document = std::make_shared<Document>();
  document->bytes = std::move(bytes);
  TakeResult result = Reader(*document, name, options).read();
  SourceInfo& source = result.take.source;
  source.name = name;
  source.format = format;
  source.document = document;
  return result;
}

}  // namespace kinemend
