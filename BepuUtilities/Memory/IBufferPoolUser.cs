namespace BepuUtilities.Memory;

/// <summary>Somebody who holds memory of a pool for long and wants to know when the pool is cleared.</summary>
public interface IBufferPoolUser
{
    /// <summary>The pool is asked to give its memory back to the system. Throws where that must not be now; then nothing happens.</summary>
    void CheckNotBusy();

    /// <summary>The pool will give its memory back to the system as soon as this returns: what lies in it is not to be touched any more.</summary>
    void ForgetMemory();
}
