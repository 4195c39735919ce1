// libmatio depends on some forty libraries (HDF5, and through it network libraries), whose loading took half of the
// program's start-up time. dynlab therefore loads it with the first MATLAB file: the functions below call the library's
// functions.
#include <dlfcn.h>
#include <matio.h>

#include "data_io/mat_variable.h"
#include "platform/error.h"

namespace dynlab::inline data_io {
namespace {

void* matio_function(const char* name) {
    static void* const library = ::dlopen(DYNLAB_MATIO, RTLD_LAZY | RTLD_LOCAL);
    void* const function = library != nullptr ? ::dlsym(library, name) : nullptr;
    if (function == nullptr) {
        const char* reason = ::dlerror();
        throw EnvironmentError(
            "MATLAB files need libmatio, which cannot be loaded: {}",
            reason != nullptr ? Message::verbatim(reason) : Message("the library does not contain {}", name));
    }
    return function;
}

template <class Function>
Function* loaded(const char* name) {
    return reinterpret_cast<Function*>(matio_function(name));
}

}  // namespace

void load_matio() {
    matio_function("Mat_Open");
}

}  // namespace dynlab::inline data_io

// NOLINTBEGIN(readability-identifier-naming): libmatio's names
int Mat_LogInitFunc(const char* program, void (*log)(int level, char* message)) {
    return dynlab::loaded<decltype(Mat_LogInitFunc)>("Mat_LogInitFunc")(program, log);
}
std::size_t Mat_SizeOf(matio_types type) {
    return dynlab::loaded<decltype(Mat_SizeOf)>("Mat_SizeOf")(type);
}
mat_t* Mat_CreateVer(const char* file, const char* header, mat_ft version) {
    return dynlab::loaded<decltype(Mat_CreateVer)>("Mat_CreateVer")(file, header, version);
}
int Mat_Close(mat_t* file) {
    return dynlab::loaded<decltype(Mat_Close)>("Mat_Close")(file);
}
mat_t* Mat_Open(const char* file, int mode) {
    return dynlab::loaded<decltype(Mat_Open)>("Mat_Open")(file, mode);
}
matvar_t* Mat_VarCreate(const char* name, matio_classes kind, matio_types type, int rank, std::size_t* size, void* data,
                        int options) {
    return dynlab::loaded<decltype(Mat_VarCreate)>("Mat_VarCreate")(name, kind, type, rank, size, data, options);
}
matvar_t* Mat_VarCreateStruct(const char* name, int rank, std::size_t* size, const char** fields, unsigned count) {
    return dynlab::loaded<decltype(Mat_VarCreateStruct)>("Mat_VarCreateStruct")(name, rank, size, fields, count);
}
void Mat_VarFree(matvar_t* variable) {
    dynlab::loaded<decltype(Mat_VarFree)>("Mat_VarFree")(variable);
}
unsigned Mat_VarGetNumberOfFields(matvar_t* variable) {
    return dynlab::loaded<decltype(Mat_VarGetNumberOfFields)>("Mat_VarGetNumberOfFields")(variable);
}
char* const* Mat_VarGetStructFieldnames(const matvar_t* variable) {
    return dynlab::loaded<decltype(Mat_VarGetStructFieldnames)>("Mat_VarGetStructFieldnames")(variable);
}
int Mat_VarReadDataAll(mat_t* file, matvar_t* variable) {
    return dynlab::loaded<decltype(Mat_VarReadDataAll)>("Mat_VarReadDataAll")(file, variable);
}
matvar_t* Mat_VarReadNextInfo(mat_t* file) {
    return dynlab::loaded<decltype(Mat_VarReadNextInfo)>("Mat_VarReadNextInfo")(file);
}
matvar_t* Mat_VarSetStructFieldByIndex(matvar_t* variable, std::size_t field, std::size_t index, matvar_t* value) {
    return dynlab::loaded<decltype(Mat_VarSetStructFieldByIndex)>("Mat_VarSetStructFieldByIndex")(variable, field,
                                                                                                  index, value);
}
int Mat_VarWrite(mat_t* file, matvar_t* variable, matio_compression compression) {
    return dynlab::loaded<decltype(Mat_VarWrite)>("Mat_VarWrite")(file, variable, compression);
}
// NOLINTEND(readability-identifier-naming)
