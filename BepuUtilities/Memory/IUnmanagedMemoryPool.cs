namespace BepuUtilities.Memory;

/// <summary>Hands out blocks of unmanaged memory and takes them back. Not thread safe unless an implementation says so.</summary>
public interface IUnmanagedMemoryPool
{
    /// <summary>Takes a buffer of exactly the asked length. Its contents are undefined.</summary>
    /// <param name="count">Length of the buffer in elements; zero is allowed and still yields memory to be returned.</param>
    /// <param name="buffer">Buffer that was taken.</param>
    void Take<T>(int count, out Buffer<T> buffer) where T : unmanaged;

    /// <summary>Takes a buffer as long as the block behind it allows, at least the asked length. Its contents are undefined.</summary>
    /// <param name="count">Least length of the buffer in elements.</param>
    /// <param name="buffer">Buffer that was taken.</param>
    void TakeAtLeast<T>(int count, out Buffer<T> buffer) where T : unmanaged;

    /// <summary>Gives a buffer back and resets the variable that held it.</summary>
    /// <exception cref="System.InvalidOperationException">The buffer is not one that this pool has handed out and not yet taken back.</exception>
    void Return<T>(ref Buffer<T> buffer) where T : unmanaged;

    /// <summary>Gives the block with this id back, whatever buffers still look at it.</summary>
    /// <exception cref="System.InvalidOperationException">No block with this id is taken.</exception>
    void ReturnUnsafely(int id);

    /// <summary>Length in elements that a buffer has when at least the given length is taken.</summary>
    int GetCapacityForCount<T>(int count) where T : unmanaged;

    /// <summary>Changes the length of a buffer to exactly the target, in place where its block allows.</summary>
    /// <param name="buffer">Buffer to resize; one without memory is taken anew.</param>
    /// <param name="targetSize">New length in elements.</param>
    /// <param name="copyCount">Number of leading elements to keep.</param>
    void Resize<T>(ref Buffer<T> buffer, int targetSize, int copyCount) where T : unmanaged;

    /// <summary>Changes the length of a buffer to all that the block for the target length holds, in place where its block allows.</summary>
    /// <param name="buffer">Buffer to resize; one without memory is taken anew.</param>
    /// <param name="targetSize">Least new length in elements.</param>
    /// <param name="copyCount">Number of leading elements to keep.</param>
    void ResizeToAtLeast<T>(ref Buffer<T> buffer, int targetSize, int copyCount) where T : unmanaged;
}
