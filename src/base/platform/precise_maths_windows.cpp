// Functions of mathematics on Windows that are as exact as those of Linux, so that results are the
// same there. MinGW-w64 multiplies for whole powers and rounds several functions twice: up to half
// of their values differ from the nearest one. With 64 bits for the way and one rounding, about one
// value in a thousand does, as with the functions of Linux. The linker puts these in the place of
// MinGW's (--wrap, see CMakeLists.txt).
#if defined(__MINGW32__)
#include <cmath>

extern "C" {

double __wrap_pow(double x, double y) { return static_cast<double>(std::pow(0.0L + x, 0.0L + y)); }
double __wrap_expm1(double x) { return static_cast<double>(std::expm1(0.0L + x)); }
double __wrap_tan(double x) { return static_cast<double>(std::tan(0.0L + x)); }
double __wrap_asin(double x) { return static_cast<double>(std::asin(0.0L + x)); }
double __wrap_acos(double x) { return static_cast<double>(std::acos(0.0L + x)); }
double __wrap_atan(double x) { return static_cast<double>(std::atan(0.0L + x)); }
double __wrap_hypot(double x, double y) {
  return static_cast<double>(std::hypot(0.0L + x, 0.0L + y));
}
}
#endif
