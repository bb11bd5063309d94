// Writes numbers in fixed notation, also if the standard library cannot.
#pragma once

namespace kinemend {

// Each function writes into [out, end), which must be long enough for any number, and returns the
// end of the written text.

/// Writes a number exactly rounded to this number of decimals.
char* write_decimals(char* out, char* end, double value, unsigned decimals);
/// Writes the fewest digits that read back as the same value.
char* write_round_trip(char* out, char* end, double value);
char* write_round_trip(char* out, char* end, float value);

/// These functions do not need `std::to_chars`, on any system.
char* write_decimals_anywhere(char* out, char* end, double value, unsigned decimals);
char* write_round_trip_anywhere(char* out, char* end, double value);
char* write_round_trip_anywhere(char* out, char* end, float value);

}  // namespace kinemend
