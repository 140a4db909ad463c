using System.IO;
using Demos.Scenes;

namespace Demos.Terminal;

/// <summary>Finds out whether a file can be written before there is anything to write.</summary>
static class OutputFile
{
    /// <summary>Refuses a path at which no file can be written; leaves what is there as it is.</summary>
    /// <exception cref="SceneException">The path is empty.</exception>
    /// <exception cref="IOException">There is no such folder, or the path is that of a folder or of no file at all.</exception>
    /// <exception cref="System.UnauthorizedAccessException">Nobody may write there.</exception>
    public static void CheckWritable(string path)
    {
        if (string.IsNullOrWhiteSpace(path) || path.Contains('\0'))
            throw new SceneException("the name of the file to write is empty or no name");
        string full = Path.GetFullPath(path);
        if (Directory.Exists(full))
            throw new IOException($"'{path}' is a folder, not a file");
        if (!Directory.Exists(Path.GetDirectoryName(full)))
            throw new DirectoryNotFoundException($"the folder of '{path}' does not exist");
        bool existed = File.Exists(full);
        using (new FileStream(full, FileMode.OpenOrCreate, FileAccess.Write))
        {
        }
        if (!existed)
            File.Delete(full);
    }
}
