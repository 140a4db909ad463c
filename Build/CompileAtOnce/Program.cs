using System;
using System.IO;
using System.Reflection;
using System.Reflection.Metadata;
using System.Reflection.Metadata.Ecma335;
using System.Reflection.PortableExecutable;

// Marks the methods of an assembly as to be compiled with all optimizations when they are first called, whatever the program that uses it
// says of compilation in tiers (Docs/decisions/warm-up.md). C# can say so of a method, not of an assembly: the mark is one bit of each row of
// the table of methods, and is set there. An assembly that has it is left as it is.
if (args is not [var path])
{
    Console.Error.WriteLine("usage: CompileAtOnce ASSEMBLY");
    return 2;
}

byte[] image = File.ReadAllBytes(path);
int count = 0;
// A copy is read, and the image written.
using (var file = new PEReader(new MemoryStream((byte[])image.Clone())))
{
    MetadataReader metadata = file.GetMetadataReader();
    int table = file.PEHeaders.MetadataStartOffset + metadata.GetTableMetadataOffset(TableIndex.MethodDef);
    int rowSize = metadata.GetTableRowSize(TableIndex.MethodDef);
    foreach (MethodDefinitionHandle handle in metadata.MethodDefinitions)
    {
        MethodDefinition method = metadata.GetMethodDefinition(handle);
        // Constructors run once, and an abstract method has nothing to compile.
        if (method.RelativeVirtualAddress == 0 || (method.Attributes & MethodAttributes.RTSpecialName) != 0)
            continue;
        // A row begins with the address of the body, in four bytes, and two of these attributes (ECMA-335, II.22.26).
        Span<byte> attributes = image.AsSpan(table + (MetadataTokens.GetRowNumber(handle) - 1) * rowSize + 4, 2);
        var marked = method.ImplAttributes | MethodImplAttributes.AggressiveOptimization;
        if (marked == method.ImplAttributes)
            continue;
        BitConverter.TryWriteBytes(attributes, (ushort)marked);
        ++count;
    }
}
if (count > 0)
    File.WriteAllBytes(path, image);
return 0;
