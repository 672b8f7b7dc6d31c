"""The OpenCL device, its programs, and one host module for each kernel: the only importer of pyopencl."""
