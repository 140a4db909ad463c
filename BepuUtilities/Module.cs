using System.Runtime.CompilerServices;

// Locals are written before they are read; clearing bundles of vectors first would cost more than many kernels do.
[module: SkipLocalsInit]
