#include "course/names/picture_samples.h"

#include <qpdf/QPDFObjectHandle.hh>

#include <initializer_list>
#include <string>

namespace dynlab::inline course {
namespace {

using Object = QPDFObjectHandle;

constexpr long long kMostOfSide = 1 << 20;  ///< samples
constexpr int kMostComponents = 32;         ///< ISO 32000-1, annex C

/// An entry by its name or by the short one that inline images have (ISO 32000-1, 8.9.7); 0 without one.
long long count_at(Object dictionary, const char* key, const char* shortly) {
    const Object value = dictionary.getKey(dictionary.hasKey(key) ? key : shortly);
    return Object(value).isInteger() ? Object(value).getIntValue() : 0;
}

bool is_named_one_of(const std::string& name, std::initializer_list<const char*> names) {
    for (const char* one : names)
        if (name == one) return true;
    return false;
}

/// Numbers of a sample in a colour space; 0 where it is none that is known.
long long numbers_of_sample(Object space) {
    const bool is_list = space.isArray() && space.getArrayNItems() > 0;
    const Object kind = is_list ? space.getArrayItem(0) : space;
    if (!Object(kind).isName()) return 0;
    const std::string name = Object(kind).getName();
    if (is_named_one_of(name, {"/DeviceGray", "/CalGray", "/G", "/Indexed", "/I", "/Separation"})) return 1;
    if (is_named_one_of(name, {"/DeviceRGB", "/CalRGB", "/Lab", "/RGB"})) return 3;
    if (is_named_one_of(name, {"/DeviceCMYK", "/CMYK"})) return 4;
    if (!is_list || space.getArrayNItems() < 2) return 0;
    const Object of = space.getArrayItem(1);
    if (name == "/ICCBased" && Object(of).isStream()) return count_at(Object(of).getDict(), "/N", "/N");
    return name == "/DeviceN" && Object(of).isArray() ? Object(of).getArrayNItems() : 0;
}

bool is_of_pictures(Object filter) {
    if (filter.isArray()) {
        for (const Object& one : filter.getArrayAsVector())
            if (is_of_pictures(one)) return true;
        return false;
    }
    return filter.isName() && is_named_one_of(filter.getName(), {"/CCITTFaxDecode", "/CCF", "/JBIG2Decode",
                                                                 "/DCTDecode", "/DCT", "/JPXDecode"});
}

}  // namespace

std::uint64_t bytes_of_samples(QPDFObjectHandle picture) {
    if (is_of_pictures(picture.getKey("/Filter"))) return 0;
    const Object mask = picture.getKey("/ImageMask");
    const bool is_mask = Object(mask).isBool() && Object(mask).getBoolValue();
    const long long width = count_at(picture, "/Width", "/W"), height = count_at(picture, "/Height", "/H");
    const long long bits = is_mask ? 1 : count_at(picture, "/BitsPerComponent", "/BPC");
    const long long components = is_mask ? 1 : numbers_of_sample(picture.getKey("/ColorSpace"));
    const auto is_within = [](long long number, long long most) { return number > 0 && number <= most; };
    if (!is_within(width, kMostOfSide) || !is_within(height, kMostOfSide) || !is_within(bits, 16) ||
        !is_within(components, kMostComponents))
        return 0;
    return static_cast<std::uint64_t>((width * components * bits + 7) / 8 * height);
}

}  // namespace dynlab::inline course
