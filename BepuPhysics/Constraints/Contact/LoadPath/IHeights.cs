namespace BepuPhysics.Constraints.Contact;

/// <summary>How high each body is, in any unit.</summary>
interface IHeights
{
    /// <summary>Height of a body of the active set.</summary>
    float Of(int body);
}
