"""The kernel held against Jupyter's own test of kernels (Debian's python3-jupyter-kernel-test)."""
import unittest

import jupyter_kernel_test


class DynlabKernel(jupyter_kernel_test.KernelTests):
    kernel_name = "dynlab"
    language_name = "lua"
    file_extension = ".lua"
    code_hello_world = 'print("hello, world")'
    completion_samples = [
        {"text": "detre", "matches": {"detrend"}},
        {"text": "math.hug", "matches": {"huge"}},
    ]
    complete_code_samples = ["1 + 1", 'print("hello")', "for i = 1, 3 do print(i) end", "G = tf(1, {1, 1})"]
    incomplete_code_samples = ["for i = 1, 3 do", "function f(x)", "x = {1,"]
    invalid_code_samples = ["x = = 2", "end"]
    code_page_something = "lsim?"
    code_generate_error = 'error("no")'
    code_execute_result = [
        {"code": "1 + 2", "result": "3"},
        {"code": '"a" .. "b"', "result": "ab"},
        {"code": "1 + 2", "result": "3"},
        {"code": "1 + 2", "result": "3"},
    ]
    code_display_data = [
        {"code": "plot({1, 2, 3}, {1, 4, 9})", "mime": mime}
        for mime in ("image/svg+xml", "image/png", "application/pdf")
    ] + [{"code": "tf(1, {1, 1})\nprint(1)", "mime": "text/latex"}]
    code_inspect_sample = "lsim"
    code_history_pattern = "1 + *"
    supported_history_operations = ("tail", "range", "search")


if __name__ == "__main__":
    unittest.main()
